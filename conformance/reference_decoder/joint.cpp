// SPDX-License-Identifier: Apache-2.0
// Reference decoder: lifting of rows and columns in one go (docs/FORMAT.md, section 7, "Joint
// lifting").
#include <functional>

#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {
namespace {

/// A value of the level at a place of its own grid.
using ValueAt = std::function<int32_t(int64_t x, int64_t y)>;

/// A predict step of a filter and the update step behind it, on a level of one patch.
class Joint {
 public:
  Joint(const WaveletHeader& header, const JointLevel& of, size_t predict, int patch, Plane& plane)
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
        width_((plane.width - 1) / of.stepX + 1),
        height_((rows_ - 1) / of.stepY + 1) {}

  void liftA() {
    const ValueAt lowered = [&](int64_t x, int64_t y) {
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

  /// All owned samples of one parity in x and y.
  void each(int64_t first_x, int64_t first_y, const std::function<void(int64_t, int64_t)>& call) {
    for (int64_t y = first_y; y < height_; y += 2) {
      for (int64_t x = first_x; x < width_; x += 2) {
        const size_t sample = index({patch_, x, y});
        if (forest_.ownerOf(sample) == sample) call(x, y);
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
  int64_t width_, height_;  ///< of the level
  const ValueAt whole_ = [this](int64_t x, int64_t y) { return at(x, y); };
};

}  // namespace

bool liftsJointly(const WaveletHeader& header, int level, const Plane& plane) {
  const bool two_steps = filterOf(header, level).steps.size() == 2;
  return header.fractionBits == 0 && header.sampleBits <= 20 && two_steps && plane.valid.empty() &&
         plane.flat.areas.empty();
}

void synthesiseJointly(const WaveletHeader& header, const JointLevel& of, Plane& plane) {
  for (size_t steps = filterOf(header, of.level).steps.size(); steps > 0; steps -= 2) {
    for (const auto& lift : {&Joint::liftA, &Joint::liftBC, &Joint::liftD}) {
      for (int patch = 0; patch < header.domain.forest.patches(); ++patch)
        (Joint(header, of, steps - 2, patch, plane).*lift)();
    }
  }
}

}  // namespace tetrakis::reference
