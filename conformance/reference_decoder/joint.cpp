// SPDX-License-Identifier: Apache-2.0
// Reference decoder: lifting of rows and columns in one go (docs/FORMAT.md, section 7, "Joint
// lifting").
#include <array>
#include <functional>

#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {
namespace {

/// A value of the level at a place of its own grid.
using ValueAt = std::function<int32_t(int64_t x, int64_t y)>;

/// FORMAT 7, "Forests": a, b (and c) and d of an area that is held, and what the
/// analysis reads of it.
struct Cell {
  int32_t a, b, d, raised = 0, lowered = 0;
};
using Cells = std::vector<Cell>;  ///< of each area

/// A predict step of a filter and the update step behind it, on a level of one patch.
class Joint {
 public:
  /// cells: what held samples become.
  Joint(const WaveletHeader& header, const JointLevel& of, size_t predict, int patch, Plane& plane,
        const Cells& cells)
      : filter_(filterOf(header, of.level)),
        predict_(predict),
        exact_(of.level > 3 || header.sampleBits + 4 >= filter_.widest),
        doubled_(doublesLow(header, of.level) && predict + 2 == filter_.steps.size()),
        ring_(header.domain.ring()),
        forest_(header.domain.forest),
        of_(of),
        patch_(patch),
        rows_(plane.height / forest_.patches()),
        plane_(plane),
        cells_(cells),
        width_((plane.width - 1) / of.stepX + 1),
        height_((rows_ - 1) / of.stepY + 1) {}

  void hold() {
    for (const int corner : {0, 1, 2, 3}) each(corner % 2, corner / 2, [](int64_t, int64_t) {});
  }
  /// What the analysis makes of a surface of one value, and reads of it.
  Cell analysed(Cell& before) const {
    const auto P = [&](int k, int32_t z) { return productOf(kPredict, k, z); };
    const auto U = [&](int k, int32_t z) { return productOf(kUpdate, k, z); };
    const auto add = [](int64_t to, int64_t v, int places) {
      return wrap(to + (wrap(wrap(v) + (int64_t{1} << (places - 1))) >> places));
    };
    const auto sixteen = [](int32_t z) { return int64_t{wrap(int64_t{z} * 16)}; };
    Cell cell = before;
    before.raised = wrap(sixteen(cell.b) + P(0, cell.a));
    cell.d = add(cell.d, P(4, before.raised) + P(0, cell.b), 4);
    cell.b = add(cell.b, P(0, cell.a) + U(0, cell.d), 4);
    before.lowered = wrap(sixteen(cell.b) - U(0, cell.d));
    const int64_t v = U(4, before.lowered) + U(0, cell.b);
    cell.a = doubled_ ? add(int64_t{cell.a} * 2, v, 3) : add(cell.a, v, 4);
    return cell;
  }

  void liftA() {
    const ValueAt lowered = [&](int64_t x, int64_t y) {
      if (const Cell* cell = cellAt(x, y)) return cell->lowered;
      return wrap(sixteenths(x, y) - alongY(kUpdate, 0, x, y, whole_));
    };
    each(0, 0, [&](int64_t x, int64_t y) {
      const int64_t v = alongX(kUpdate, 4, x, y, lowered) + alongY(kUpdate, 0, x, y, whole_);
      if (!doubled_) return change(x, y, v);
      const int32_t twice = wrap(at(x, y) - int64_t{wrap(wrap(v) + int64_t{4}) >> 3});
      at(x, y) = wrap(twice + int64_t{1}) >> 1;
    });
  }
  void liftBC() {
    each(1, 0, [&](int64_t x, int64_t y) {
      change(x, y, alongX(kPredict, 0, x, y, whole_) + alongY(kUpdate, 0, x, y, whole_));
    });
    each(0, 1, [&](int64_t x, int64_t y) {
      change(x, y, alongX(kUpdate, 0, x, y, whole_) + alongY(kPredict, 0, x, y, whole_));
    });
  }
  void liftD() {
    const ValueAt raised = [&](int64_t x, int64_t y) {
      if (const Cell* cell = cellAt(x, y)) return cell->raised;
      return wrap(sixteenths(x, y) + alongY(kPredict, 0, x, y, whole_));
    };
    each(1, 1, [&](int64_t x, int64_t y) {
      change(x, y, alongX(kPredict, 4, x, y, raised) + alongY(kPredict, 0, x, y, whole_));
    });
  }

 private:
  enum Step { kPredict, kUpdate };

  /// Of a sample of the patch, in the raster.
  size_t index(const Place& at) const {
    const auto x = static_cast<int>(at.x * of_.stepX), y = static_cast<int>(at.y * of_.stepY);
    return plane_.index(x, static_cast<int>(at.patch) * rows_ + y);
  }
  /// "Samples that are not owned become what the owned ones are": those are taken at once.
  int32_t& at(int64_t x, int64_t y) {
    const Place place = forest_.locate({patch_, x, y}, width_ - 1, height_ - 1);
    return plane_.values.at(forest_.ownerOf(index(place)));
  }
  int64_t sixteenths(int64_t x, int64_t y) { return wrap(int64_t{at(x, y)} * 16); }

  /// Of a held sample; null: it is not held.
  const Cell* cellAt(int64_t x, int64_t y) const {
    const Place place = forest_.locate({patch_, x, y}, width_ - 1, height_ - 1);
    const uint32_t area = plane_.flat.areas.empty() ? 0 : plane_.flat.areas.at(index(place));
    return area > 0 ? &cells_.at(area - 1) : nullptr;
  }
  /// All owned samples of one parity in x and y; those that are held get their value instead.
  void each(int64_t first_x, int64_t first_y, const std::function<void(int64_t, int64_t)>& call) {
    for (int64_t y = first_y; y < height_; y += 2) {
      for (int64_t x = first_x; x < width_; x += 2) {
        const size_t sample = index({patch_, x, y});
        if (forest_.ownerOf(sample) != sample) continue;
        if (const Cell* cell = cellAt(x, y))
          at(x, y) = first_x != first_y ? cell->b : first_x == 0 ? cell->a : cell->d;
        else
          call(x, y);
      }
    }
  }
  /// P or U of k. beside(t): the value so far away.
  int64_t product(Step step, int k, const std::function<int64_t(int64_t)>& beside) const {
    const int shift = filter_.shift - 4 + k;
    int64_t sum = int64_t{1} << (shift - 1), distance = 1;
    for (const int weight : filter_.steps.at(predict_ + step)) {
      sum += weight * (beside(-distance) + beside(distance));
      distance += 2;
    }
    return wrap((exact_ ? sum : wrap(sum)) >> shift);
  }
  /// Of values that are all z.
  int64_t productOf(Step step, int k, int32_t z) const {
    return product(step, k, [&](int64_t) { return int64_t{z}; });
  }
  int64_t alongX(Step step, int k, int64_t x, int64_t y, const ValueAt& value) const {
    return product(step, k,
                   [&](int64_t d) { return ring_ ? round(x + d, y, value) : value(x + d, y); });
  }
  int64_t alongY(Step step, int k, int64_t x, int64_t y, const ValueAt& value) const {
    return product(step, k, [&](int64_t d) { return value(x, y + d); });
  }

  /// "Rings"
  int64_t round(int64_t x, int64_t y, const ValueAt& value) const {
    const int64_t places = width_ + width_ % 2;
    x = (x % places + places) % places;
    if (x < width_) return value(x, y);
    return (int64_t{value(width_ - 2, y)} + value(1, y)) >> 1;
  }

  void change(int64_t x, int64_t y, int64_t v) {
    at(x, y) = wrap(at(x, y) - int64_t{wrap(wrap(v) + int64_t{8}) >> 4});
  }

  const Filter& filter_;
  size_t predict_;
  bool exact_, doubled_, ring_;
  const Forest& forest_;
  JointLevel of_;
  int patch_, rows_;
  Plane& plane_;
  const Cells& cells_;
  int64_t width_, height_;  ///< of the level
  const ValueAt whole_ = [this](int64_t x, int64_t y) { return at(x, y); };
};

}  // namespace

bool liftsJointly(const WaveletHeader& header, int level, const Plane& plane) {
  const bool two_steps = filterOf(header, level).steps.size() == 2;
  return header.fractionBits == 0 && header.sampleBits <= 20 && two_steps && plane.valid.empty() &&
         plane.flat.areas.empty();
}

namespace {

/// The cells before the analysis of a level, and after it.
std::array<Cells, 2> cellsOf(const WaveletHeader& header, int level, Plane& plane) {
  std::array<Cells, 2> cells;
  auto& [before, after] = cells;
  for (const int32_t value : plane.flat.heights) after.push_back({value, value, value});
  for (int l = 1; l <= level; ++l) {
    before.clear();
    for (const Cell& cell : after) before.push_back({cell.a, cell.a, cell.a});
    const Joint joint(header, {l, 1 << (l - 1), 1 << (l - 1)}, 0, 0, plane, before);
    for (size_t i = 0; i < after.size(); ++i) after[i] = joint.analysed(before[i]);
  }
  return cells;
}

}  // namespace

void synthesiseJointly(const WaveletHeader& header, const JointLevel& of, Plane& plane) {
  const int patches = header.domain.forest.patches();
  const auto [before, after] = cellsOf(header, of.level, plane);
  for (int patch = 0; patch < patches; ++patch) Joint(header, of, 0, patch, plane, after).hold();
  for (size_t steps = filterOf(header, of.level).steps.size(); steps > 0; steps -= 2) {
    for (const auto& lift : {&Joint::liftA, &Joint::liftBC, &Joint::liftD}) {
      for (int patch = 0; patch < patches; ++patch)
        (Joint(header, of, steps - 2, patch, plane, before).*lift)();
    }
  }
}

}  // namespace tetrakis::reference
