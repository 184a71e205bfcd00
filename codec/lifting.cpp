// SPDX-License-Identifier: Apache-2.0
#include "codec/lifting.hpp"

#include <algorithm>

#include "codec/stencil.hpp"

namespace tetrakis {

namespace {

constexpr int kPredictShift = 9;  // weights sum to 2^9
constexpr int kUpdateShift = 10;  // the update takes half of them

int64_t roundedShift(int64_t sum, int shift) {
  return (sum + (int64_t{1} << (shift - 1))) >> shift;
}

int64_t roundedQuotient(int64_t sum, int64_t divisor) {
  const int64_t shifted = 2 * sum + divisor, whole = 2 * divisor;
  return shifted / whole - (shifted % whole < 0);
}

/// One lifting step: the targets of a row run through their stencil.
class Step {
 public:
  Step(std::span<int32_t> values, uint32_t width, uint32_t height, const Level& level)
      : values_(values),
        width_(width),
        height_(height),
        level_(level),
        stencil_(stencilOf(level.kind, level.step, width)) {}

  /// x_new -+= prediction from the coarser vertices.
  template <int kSign>
  void predict() {
    for (uint32_t row = 0; row < level_.shape.rows; ++row) {
      targets<kSign, true>(level_.y(row), level_.firstX(row));
    }
  }

  /// x_old +-= half the same average of the details, at every coarser vertex.
  template <int kSign>
  void update() {
    const uint32_t s = level_.step;
    if (level_.kind == LevelKind::kCentres) {
      for (uint32_t y = 0; y < height_; y += 2 * s) targets<kSign, false>(y, 0);
    } else {
      for (uint32_t row = 0, y = 0; y < height_; ++row, y += s) {
        targets<kSign, false>(y, row % 2 == 0 ? 0 : s);
      }
    }
  }

 private:
  template <int kSign, bool kPredict>
  void targets(uint32_t y, uint32_t first_x) {
    const uint32_t pitch = 2 * level_.step, reach = static_cast<uint32_t>(stencil_.reach);
    const bool interior_row = y >= reach && y + reach < height_;
    for (uint32_t x = first_x; x < width_; x += pitch) {
      if (interior_row && x >= reach && x + reach < width_) {
        const uint32_t end = width_ - reach;
        for (; x < end; x += pitch) apply<kSign>(x, y, inside<kPredict>(x, y));
        x -= pitch;
      } else {
        apply<kSign>(x, y, atBorder<kPredict>(x, y));
      }
    }
  }

  template <int kSign>
  void apply(uint32_t x, uint32_t y, int64_t change) {
    int32_t& v = values_[size_t{y} * width_ + x];
    v = static_cast<int32_t>(static_cast<uint32_t>(v) + static_cast<uint32_t>(kSign * change));
  }

  template <bool kPredict>
  int64_t inside(uint32_t x, uint32_t y) const {
    const int32_t* v = values_.data() + size_t{y} * width_ + x;
    int64_t sum = 0;
    int tap = 0;
    for (size_t ring = 0; ring < Stencil::kRingSize.size(); ++ring) {
      int64_t ring_sum = 0;
      for (int i = 0; i < Stencil::kRingSize[ring]; ++i) ring_sum += v[stencil_.linear[tap++]];
      sum += Stencil::kRingWeight[ring] * ring_sum;
    }
    return roundedShift(sum, kPredict ? kPredictShift : kUpdateShift);
  }

  template <bool kPredict>
  int64_t atBorder(uint32_t x, uint32_t y) const {
    int64_t sum = 0, weights = 0;
    int tap = 0;
    for (size_t ring = 0; ring < Stencil::kRingSize.size(); ++ring) {
      for (int i = 0; i < Stencil::kRingSize[ring]; ++i, ++tap) {
        const int64_t nx = mirrored(x, stencil_.dx[tap], width_);
        const int64_t ny = mirrored(y, stencil_.dy[tap], height_);
        if (nx < 0 || ny < 0) continue;
        sum += Stencil::kRingWeight[ring] *
               int64_t{values_[static_cast<size_t>(ny) * width_ + static_cast<size_t>(nx)]};
        weights += Stencil::kRingWeight[ring];
      }
    }
    if (!kPredict) return roundedShift(sum, kUpdateShift);
    return weights > 0 ? roundedQuotient(sum, weights) : 0;
  }

  /// at + offset, or at - offset if that is outside [0, size), or -1 if both are.
  static int64_t mirrored(uint32_t at, int offset, uint32_t size) {
    const int64_t direct = int64_t{at} + offset, image = int64_t{at} - offset;
    if (direct >= 0 && direct < size) return direct;
    return image >= 0 && image < size ? image : -1;
  }

  std::span<int32_t> values_;
  uint32_t width_, height_;
  const Level& level_;
  Stencil stencil_;
};

}  // namespace

void forwardLifting(std::span<int32_t> values, uint32_t width, uint32_t height) {
  const std::vector<Level> levels = levelsOf(width, height);
  for (size_t i = levels.size() - 1; i > 0; --i) {
    Step step(values, width, height, levels[i]);
    step.predict<-1>();
    step.update<1>();
  }
}

void inverseLifting(std::span<int32_t> values, uint32_t width, uint32_t height) {
  const std::vector<Level> levels = levelsOf(width, height);
  for (size_t i = 1; i < levels.size(); ++i) {
    Step step(values, width, height, levels[i]);
    step.update<-1>();
    step.predict<1>();
  }
}

}  // namespace tetrakis
