// SPDX-License-Identifier: Apache-2.0
#include "codec/lifting.hpp"

#include <algorithm>
#include <optional>

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
  Step(const LiftedGrid& grid, const Level& level)
      : values_(grid.values),
        valid_(grid.valid.empty() ? nullptr : grid.valid.data()),
        width_(grid.width),
        height_(grid.height),
        level_(level),
        stencil_(stencilOf(level.kind, level.step, grid.width)) {}

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
    const bool interior_row = y >= reach && y + reach < height_ && valid_ == nullptr;
    for (uint32_t x = first_x; x < width_; x += pitch) {
      if (interior_row && x >= reach && x + reach < width_) {
        const uint32_t end = width_ - reach;
        for (; x < end; x += pitch) apply<kSign>(x, y, inside<kPredict>(x, y));
        x -= pitch;
      } else if (valid_ == nullptr || valid_[size_t{y} * width_ + x]) {
        apply<kSign>(x, y, whereSomeAreMissing<kPredict>(x, y));
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
  int64_t whereSomeAreMissing(uint32_t x, uint32_t y) const {
    int64_t sum = 0, weights = 0;
    std::optional<int64_t> nearest;  // mean of the first ring that has anyone
    int tap = 0;
    for (size_t ring = 0; ring < Stencil::kRingSize.size(); ++ring) {
      int64_t ring_sum = 0, there = 0;
      for (int i = 0; i < Stencil::kRingSize[ring]; ++i, ++tap) {
        const int64_t neighbour = present(x, y, stencil_.dx[tap], stencil_.dy[tap]);
        if (neighbour < 0) continue;
        ring_sum += values_[static_cast<size_t>(neighbour)];
        ++there;
      }
      if (there > 0 && !nearest) nearest = roundedQuotient(ring_sum, there);
      sum += Stencil::kRingWeight[ring] * ring_sum;
      weights += Stencil::kRingWeight[ring] * there;
    }
    if (!kPredict) return roundedShift(sum, kUpdateShift);
    if (valid_ != nullptr && weights != Stencil::kWeightSum) return nearest.value_or(0);
    return weights > 0 ? roundedQuotient(sum, weights) : 0;
  }

  /// The neighbour at an offset, mirrored at the border; where that is void the opposite one; -1
  /// where neither is there.
  int64_t present(uint32_t x, uint32_t y, int dx, int dy) const {
    const int64_t neighbour = inGrid(x, y, dx, dy);
    if (valid_ == nullptr || neighbour < 0 || valid_[neighbour]) return neighbour;
    const int64_t opposite = inGrid(x, y, -dx, -dy);
    return opposite >= 0 && valid_[opposite] ? opposite : -1;
  }

  int64_t inGrid(uint32_t x, uint32_t y, int dx, int dy) const {
    const int64_t nx = mirrored(x, dx, width_), ny = mirrored(y, dy, height_);
    return nx < 0 || ny < 0 ? -1 : ny * width_ + nx;
  }

  std::span<int32_t> values_;
  const uint8_t* valid_;  ///< null where all are
  uint32_t width_, height_;
  const Level& level_;
  Stencil stencil_;
};

}  // namespace

void forwardLifting(const LiftedGrid& grid) {
  const std::vector<Level> levels = levelsOf(grid.width, grid.height);
  for (size_t i = levels.size() - 1; i > 0; --i) {
    Step step(grid, levels[i]);
    step.predict<-1>();
    step.update<1>();
  }
}

void inverseLifting(const LiftedGrid& grid) {
  const std::vector<Level> levels = levelsOf(grid.width, grid.height);
  for (size_t i = 1; i < levels.size(); ++i) {
    Step step(grid, levels[i]);
    step.update<-1>();
    step.predict<1>();
  }
}

}  // namespace tetrakis
