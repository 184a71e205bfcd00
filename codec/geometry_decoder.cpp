// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry_decoder.hpp"

#include <utility>

#include "bitstream/track_decoder.hpp"
#include "codec/geometry_plan.hpp"
#include "codec/lifting.hpp"

namespace tetrakis {

namespace {

void scatter(const Band& band, const Level& level, uint32_t width, DecodedGeometry& out) {
  if (!band.nonzero) return;
  for (uint32_t row = 0; row < level.shape.rows; ++row) {
    size_t at = size_t{level.y(row)} * width + level.firstX(row);
    const size_t first = level.shape.cell(row, 0);
    for (uint32_t column = 0; column < level.shape.columns[row % 2]; ++column) {
      const int32_t value = band.value(first + column);
      out.heights[at] = value;
      out.significant[at] = value != 0;
      at += level.pitch();
    }
  }
}

/// Coefficients of void vertices mean nothing.
void clearVoids(DecodedGeometry& geometry) {
  for (size_t i = 0; i < geometry.valid.size(); ++i) {
    if (geometry.valid[i]) continue;
    geometry.heights[i] = 0;
    geometry.significant[i] = 0;
  }
}

}  // namespace

DecodedGeometry decodeGeometry(std::span<const uint8_t> codeword, int planes, uint32_t width,
                               uint32_t height, std::vector<uint8_t> valid) {
  const size_t samples = size_t{width} * height;
  DecodedGeometry out{std::vector<int32_t>(samples, 0), std::vector<uint8_t>(samples, 0),
                      std::move(valid)};
  const GeometryPlan plan(width, height);
  const TrackState state = decodeTrack(plan.bands(), planes, plan, codeword);
  for (size_t i = 0; i < plan.levels().size(); ++i) {
    scatter(state.bands[i], plan.levels()[i], width, out);
  }
  clearVoids(out);
  inverseLifting({out.heights, width, height, out.valid});
  return out;
}

void dropFraction(std::vector<int32_t>& heights, int bits) {
  if (bits == 0) return;
  for (int32_t& h : heights) {
    h = static_cast<int32_t>((int64_t{h} + (int64_t{1} << (bits - 1))) >> bits);
  }
}

}  // namespace tetrakis
