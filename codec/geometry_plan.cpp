// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry_plan.hpp"

#include <algorithm>

namespace tetrakis {

namespace {

class NoHints : public HintSource {
 public:
  void fill(uint32_t, uint32_t, uint32_t count, uint32_t* hints) const override {
    std::fill_n(hints, count, 0u);
  }
};

/// A centre's square has two corners that are midpoints of the level before: (a + 1, b) and
/// (a, b + 1) where a + b is even, (a, b) and (a + 1, b + 1) where it is odd, in units of the side.
class CentreHints : public HintSource {
 public:
  explicit CentreHints(const Band& midpoints) : midpoints_(midpoints) {}
  void fill(uint32_t b, uint32_t column, uint32_t count, uint32_t* hints) const override {
    const uint32_t* top = midpoints_.magnitude.data() + midpoints_.shape.cell(b, 0);
    const uint32_t* bottom = top + midpoints_.shape.stride();
    for (uint32_t a = column; a < column + count; ++a) {
      const uint32_t even = (a + b + 1) & 1;
      *hints++ = 2 * (top[(a + even) >> 1] + bottom[(a + 1 - even) >> 1]);
    }
  }

 private:
  const Band& midpoints_;
};

/// A midpoint lies between two centres of the same step: above and below it in even rows, left and
/// right of it in odd rows.
class MidpointHints : public HintSource {
 public:
  explicit MidpointHints(const Band& centres) : centres_(centres) {}
  void fill(uint32_t row, uint32_t column, uint32_t count, uint32_t* hints) const override {
    const ptrdiff_t stride = centres_.shape.stride();
    const uint32_t* centre = centres_.magnitude.data() + centres_.shape.cell(row / 2, column);
    const ptrdiff_t other = row % 2 == 0 ? -stride : -1;
    for (uint32_t i = 0; i < count; ++i) *hints++ = 2 * (centre[i] + centre[i + other]);
  }

 private:
  const Band& centres_;
};

/// The finest steps hold most samples and get contexts of their own.
uint32_t modelsOf(const Level& level) {
  if (level.kind == LevelKind::kRoots) return 0;
  const uint32_t scale = level.step == 1 ? 0 : level.step == 2 ? 1 : 2;
  return (level.kind == LevelKind::kCentres ? 1 : 4) + scale;
}

}  // namespace

GeometryPlan::GeometryPlan(uint32_t width, uint32_t height) : levels_(levelsOf(width, height)) {
  for (const Level& level : levels_) {
    bands_.push_back({level.shape, logNormOf(level), modelsOf(level)});
  }
}

std::unique_ptr<HintSource> GeometryPlan::hints(const TrackState& state, uint32_t band) const {
  if (band < 2) return std::make_unique<NoHints>();
  const Band& before = state.bands[band - 1];
  if (levels_[band].kind == LevelKind::kCentres) return std::make_unique<CentreHints>(before);
  return std::make_unique<MidpointHints>(before);
}

}  // namespace tetrakis
