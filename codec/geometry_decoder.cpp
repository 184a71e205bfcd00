// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry_decoder.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "bitstream/track_decoder.hpp"
#include "wavelet/band_plan.hpp"
#include "wavelet/mip_level.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis {

namespace {

/// Marks the vertices that the band's significant coefficients belong to.
void markVertices(const Band& band, const Subband& subband, uint32_t width,
                  std::vector<uint8_t>& marks) {
  for (uint32_t row = 0; row < subband.height; ++row) {
    uint8_t* out = marks.data() + size_t{subband.planeRow(row)} * width;
    for (uint32_t x = 0; x < band.shape.words(); ++x) {
      uint32_t todo = band.significant[band.shape.word(row, x)];
      for (; todo != 0; todo &= todo - 1) {
        out[subband.sampleColumn(32 * x + static_cast<uint32_t>(std::countr_zero(todo)))] = 1;
      }
    }
  }
}

uint32_t quietLevels(const TrackState& state, std::span<const Subband> subbands) {
  uint32_t quiet = static_cast<uint32_t>(subbands.front().level);
  for (size_t i = 1; i < subbands.size(); ++i) {
    const auto level = static_cast<uint32_t>(subbands[i].level);
    if (state.bands[i].nonzero) quiet = std::min(quiet, level - 1);
  }
  return quiet;
}

/// The guess at an insignificant coefficient means nothing where there is none.
void clearVoids(DecodedGeometry& geometry) {
  for (size_t i = 0; i < geometry.valid.size(); ++i) {
    if (!geometry.valid[i]) geometry.heights[i] = 0;
  }
}

template <class T>
void thin(const MipLevel& mip, std::vector<T>& values) {
  mip.thin(std::span(values));
  values.resize(mip.samples());
}

}  // namespace

DecodedGeometry decodeGeometry(const GeometryHeader& header, std::span<const uint8_t> codeword,
                               std::vector<uint8_t> valid, int level) {
  const WaveletSpec spec = specOf(header.wavelet);
  const PlaneLayout layout(spec, header.width, header.height);
  const MipLevel mip(header.width, header.height, level);
  std::vector<BandPlan> plan = layout.plan(0, 0, 0);
  markAbsent(layout, valid, header.width, plan);
  mip.dropFiner(plan);
  const TrackState state = decodeTrack(plan, header.planes, codeword);
  const auto [width, height] = mip.low();
  DecodedGeometry out;
  out.valid = level == 0 ? std::move(valid) : mip.maskOf(valid, header.width);
  out.fraction_bits = outputFractionBits(header.wavelet, header.planes, state.complete);
  out.heights.resize(size_t{width} * height);
  out.significant.resize(out.heights.size());
  const std::vector<Subband> subbands = subbandsOf(width, height);
  for (size_t i = 0; i < subbands.size(); ++i) {
    scatter(state.bands[i], out.fraction_bits - header.wavelet.fraction_bits, subbands[i],
            out.heights, width);
    markVertices(state.bands[i], subbands[i], width, out.significant);
  }
  out.quiet_levels = quietLevels(state, subbands);
  inverseWavelet(mip.transform(spec), out.heights, width, height, out.valid);
  clearVoids(out);
  mip.normalise(spec, out.heights);
  thin(mip, out.heights);
  thin(mip, out.significant);
  if (!out.valid.empty()) thin(mip, out.valid);
  out.width = mip.size().width;
  out.height = mip.size().height;
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
