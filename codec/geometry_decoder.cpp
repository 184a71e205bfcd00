// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry_decoder.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "bitstream/track_decoder.hpp"
#include "wavelet/band_plan.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis {

namespace {

/// Marks the vertices that the band's significant coefficients belong to.
void markVertices(const Band& band, const Subband& subband, uint32_t width,
                  std::vector<uint8_t>& marks) {
  if (band.shape.empty()) return;
  const bool high_x =
      subband.orientation == Orientation::kHL || subband.orientation == Orientation::kHH;
  const uint32_t first = high_x ? uint32_t{1} << (subband.splits_x - 1) : 0;
  for (uint32_t row = 0; row < subband.height; ++row) {
    uint8_t* out = marks.data() + size_t{subband.planeRow(row)} * width + first;
    for (uint32_t x = 0; x < band.shape.words(); ++x) {
      uint32_t todo = band.significant[band.shape.word(row, x)];
      for (; todo != 0; todo &= todo - 1) {
        const size_t column = 32 * size_t{x} + static_cast<size_t>(std::countr_zero(todo));
        out[column << subband.splits_x] = 1;
      }
    }
  }
}

uint32_t quietLevels(const TrackState& state, const PlaneLayout& layout) {
  uint32_t quiet = static_cast<uint32_t>(layout.subbands().front().level);
  for (size_t i = 1; i < layout.size(); ++i) {
    const auto level = static_cast<uint32_t>(layout.subbands()[i].level);
    if (state.bands[i].nonzero) quiet = std::min(quiet, level - 1);
  }
  return quiet;
}

/// Coefficients of void vertices mean nothing.
void clearVoids(DecodedGeometry& geometry) {
  for (size_t i = 0; i < geometry.valid.size(); ++i) {
    if (!geometry.valid[i]) geometry.heights[i] = geometry.significant[i] = 0;
  }
}

}  // namespace

DecodedGeometry decodeGeometry(const GeometryHeader& header, std::span<const uint8_t> codeword,
                               std::vector<uint8_t> valid) {
  const uint32_t width = header.width, height = header.height;
  const WaveletSpec spec = specOf(header.wavelet);
  const PlaneLayout layout(spec, width, height);
  const TrackState state = decodeTrack(layout.plan(0, 0, 0), header.planes, codeword);
  DecodedGeometry out;
  out.valid = std::move(valid);
  out.fraction_bits = outputFractionBits(header.wavelet, header.planes, state.complete);
  out.heights.resize(size_t{width} * height);
  out.significant.resize(out.heights.size());
  for (size_t i = 0; i < layout.size(); ++i) {
    const Subband& subband = layout.subbands()[i];
    scatter(state.bands[i], out.fraction_bits - header.wavelet.fraction_bits, subband, out.heights,
            width);
    markVertices(state.bands[i], subband, width, out.significant);
  }
  out.quiet_levels = quietLevels(state, layout);
  inverseWavelet(spec, out.heights, width, height, out.valid);
  clearVoids(out);
  return out;
}

std::vector<int32_t> wholeSteps(const DecodedGeometry& decoded) {
  std::vector<int32_t> steps = decoded.heights;
  const int bits = decoded.fraction_bits;
  if (bits == 0) return steps;
  const int64_t half = int64_t{1} << (bits - 1);
  for (int32_t& q : steps) q = static_cast<int32_t>((q + half) >> bits);
  return steps;
}

}  // namespace tetrakis
