// SPDX-License-Identifier: Apache-2.0
// Reference decoder: lifting of rows and columns in one go (docs/FORMAT.md, section 7, "Joint
// lifting").
#include <functional>

#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {
namespace {

/// A value of the level at a place of its own grid.
using ValueAt = std::function<int32_t(int64_t x, int64_t y)>;

/// "Mirrored about the first and the last sample (period 2n - 2)".
int64_t mirrored(int64_t t, int64_t n) {
  const int64_t period = 2 * n - 2;
  t = (t % period + period) % period;
  return t < n ? t : period - t;
}

class Joint {
 public:
  Joint(const WaveletHeader& header, const JointLevel& of, Plane& plane)
      : filter_(filterOf(header, of.level)),
        exact_(of.level > 3 || header.sampleBits + 4 >= filter_.widest),
        doubled_(doublesLow(header, of.level)),
        ring_(header.ring),
        of_(of),
        plane_(plane),
        width_((plane.width - 1) / of.stepX + 1),
        height_((plane.height - 1) / of.stepY + 1) {}

  void synthesise() {
    const ValueAt whole = [this](int64_t x, int64_t y) { return at(x, y); };
    const ValueAt raised = [&](int64_t x, int64_t y) {  // c + Py a
      return wrap(sixteenths(x, y) + alongY(0, 4, x, y, whole));
    };
    each(0, 0, [&](int64_t x, int64_t y) { corner(x, y, cornerBracket(x, y)); });
    each(1, 0, [&](int64_t x, int64_t y) {
      change(x, y, wrap(int64_t{alongX(0, 4, x, y, whole)} + alongY(1, 4, x, y, whole)));
    });
    each(0, 1, [&](int64_t x, int64_t y) {
      change(x, y, wrap(int64_t{alongX(1, 4, x, y, whole)} + alongY(0, 4, x, y, whole)));
    });
    each(1, 1, [&](int64_t x, int64_t y) {
      change(x, y, wrap(int64_t{alongX(0, 8, x, y, raised)} + alongY(0, 4, x, y, whole)));
    });
  }

 private:
  size_t index(int64_t x, int64_t y) const {
    return plane_.index(static_cast<int>(x) * of_.stepX, static_cast<int>(y) * of_.stepY);
  }
  int32_t& at(int64_t x, int64_t y) { return plane_.values.at(index(x, y)); }
  int64_t sixteenths(int64_t x, int64_t y) { return wrap(int64_t{at(x, y)} * 16); }

  /// All places of one parity in x and y.
  void each(int64_t first_x, int64_t first_y, const std::function<void(int64_t, int64_t)>& call) {
    for (int64_t y = first_y; y < height_; y += 2) {
      for (int64_t x = first_x; x < width_; x += 2) call(x, y);
    }
  }
  /// A step of the filter with so many bits shifted out. value(t): of a place beside.
  int32_t product(size_t step, int shift, const std::function<int64_t(int64_t)>& beside) const {
    int64_t sum = int64_t{1} << (shift - 1), distance = 1;
    for (const int weight : filter_.steps.at(step)) {
      sum += weight * (beside(-distance) + beside(distance));
      distance += 2;
    }
    return wrap((exact_ ? sum : wrap(sum)) >> shift);
  }
  int32_t alongX(size_t step, int shift, int64_t x, int64_t y, const ValueAt& value) const {
    return product(step, shift, [&](int64_t d) {
      return ring_ ? round(x + d, y, value) : value(mirrored(x + d, width_), y);
    });
  }
  int32_t alongY(size_t step, int shift, int64_t x, int64_t y, const ValueAt& value) const {
    return product(step, shift, [&](int64_t d) { return value(x, mirrored(y + d, height_)); });
  }

  /// "Rings"
  int64_t round(int64_t x, int64_t y, const ValueAt& value) const {
    const int64_t places = width_ + width_ % 2;
    x = (x % places + places) % places;
    if (x < width_) return value(x, y);
    return (int64_t{value(width_ - 2, y)} + value(1, y)) >> 1;
  }

  /// Ux (b - Uy d) + Uy c
  int32_t cornerBracket(int64_t x, int64_t y) {
    const ValueAt whole = [this](int64_t u, int64_t v) { return at(u, v); };
    const ValueAt lowered = [&](int64_t u, int64_t v) {
      return wrap(sixteenths(u, v) - alongY(1, 4, u, v, whole));
    };
    return wrap(int64_t{alongX(1, 8, x, y, lowered)} + alongY(1, 4, x, y, whole));
  }
  void change(int64_t x, int64_t y, int32_t bracket) {
    at(x, y) = wrap(int64_t{at(x, y)} - (wrap(int64_t{bracket} + 8) >> 4));
  }
  void corner(int64_t x, int64_t y, int32_t bracket) {
    if (!doubled_) return change(x, y, bracket);
    const int32_t twice = wrap(int64_t{at(x, y)} - (wrap(int64_t{bracket} + 4) >> 3));
    at(x, y) = wrap(int64_t{twice} + 1) >> 1;
  }

  const Filter& filter_;
  bool exact_, doubled_, ring_;
  JointLevel of_;
  Plane& plane_;
  int64_t width_, height_;
};

}  // namespace

bool liftsJointly(const WaveletHeader& header, int level, const Plane& plane) {
  const bool two_steps = filterOf(header, level).steps.size() == 2;
  return header.fractionBits == 0 && header.sampleBits <= 20 && two_steps && plane.valid.empty() &&
         plane.flat.areas.empty();
}

void synthesiseJointly(const WaveletHeader& header, const JointLevel& of, Plane& plane) {
  Joint(header, of, plane).synthesise();
}

}  // namespace tetrakis::reference
