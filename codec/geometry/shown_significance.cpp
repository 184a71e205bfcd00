// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/shown_significance.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

#include "codec/wavelet/synthesis/plane_synthesis.hpp"

namespace tetrakis::inline geometry {

ShownSignificance::ShownSignificance(const Pyramid& pyramid, const View& view, size_t tracks)
    : pyramid_(pyramid),
      level_(view.level),
      low_(pyramid.low(view.level)),
      shown_(view.window.value_or(Window{0, 0, low_.extent.width, low_.extent.height})),
      is_window_(view.window.has_value()),
      marks_(shown_.extent().samples()),
      quiet_(tracks, pyramid.levels() - view.level) {}

void ShownSignificance::take(size_t track, const TrackState& state,
                             std::span<const BandPart> parts) {
  const size_t subbands = pyramid_.subbandsOf(level_).size();
  for (size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].subband >= subbands) continue;
    const Subband& subband = pyramid_.subbands()[parts[i].subband];
    mark(state.bands[i], subband, parts[i]);
    if (state.bands[i].nonzero() && subband.orientation != Orientation::kLL)
      quiet_[track] = std::min(quiet_[track], subband.level - 1 - level_);
  }
}

void ShownSignificance::giveTo(DecodedGeometry& geometry) {
  assert(!quiet_.empty());
  if (!is_window_) {
    geometry.quiet_levels = static_cast<uint32_t>(*std::min_element(quiet_.begin(), quiet_.end()));
    marks_.resize(thin(pyramid_, level_, std::span(marks_)));
  }
  geometry.significant = std::move(marks_);
}

/// Marks the vertices that the significant coefficients of the part belong to.
void ShownSignificance::mark(const Band& band, const Subband& subband, const BandPart& part) {
  if (band.shape.empty()) return;
  const int splits = subband.splits_x - low_.splits_x;
  const size_t first = (subband.isHighX() ? size_t{1} << (splits - 1) : 0) - shown_.x;
  for (uint32_t row = 0; row < part.rows; ++row) {
    const uint32_t y = (subband.planeRow(part.row + row) >> low_.splits_y) - shown_.y;
    if (y >= shown_.height) continue;
    uint8_t* out = marks_.data() + size_t{y} * shown_.width;
    for (uint32_t x = 0; x < band.shape.words(); ++x) {
      uint32_t todo = band.significant[band.shape.word(row, x)];
      for (; todo != 0; todo &= todo - 1) {
        const size_t column =
            part.column + 32 * size_t{x} + static_cast<size_t>(std::countr_zero(todo));
        const size_t shown = first + (column << splits);
        if (shown < shown_.width) out[shown] = 1;
      }
    }
  }
}

}  // namespace tetrakis::inline geometry
