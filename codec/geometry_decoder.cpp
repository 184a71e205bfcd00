// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry_decoder.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "wavelet/band_plan.hpp"
#include "wavelet/region_decoder.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis {

namespace {

/// Marks the vertices that the part's significant coefficients belong to.
void markVertices(const Band& band, const Subband& subband, const BandPart& part, uint32_t width,
                  std::vector<uint8_t>& marks) {
  if (band.shape.empty()) return;
  const bool high_x =
      subband.orientation == Orientation::kHL || subband.orientation == Orientation::kHH;
  const size_t first = high_x ? size_t{1} << (subband.splits_x - 1) : 0;
  for (uint32_t row = 0; row < part.rows; ++row) {
    uint8_t* out = marks.data() + size_t{subband.planeRow(part.row + row)} * width + first;
    for (uint32_t x = 0; x < band.shape.words(); ++x) {
      uint32_t todo = band.significant[band.shape.word(row, x)];
      for (; todo != 0; todo &= todo - 1) {
        const size_t column =
            part.column + 32 * size_t{x} + static_cast<size_t>(std::countr_zero(todo));
        out[column << subband.splits_x] = 1;
      }
    }
  }
}

uint32_t quietLevels(const TrackState& state, const PlaneLayout& layout,
                     std::span<const BandPart> parts) {
  auto quiet = static_cast<uint32_t>(layout.subbands().front().level);
  for (size_t i = 0; i < parts.size(); ++i) {
    const Subband& subband = layout.subbands()[parts[i].subband];
    if (subband.orientation == Orientation::kLL || !state.bands[i].nonzero) continue;
    quiet = std::min(quiet, static_cast<uint32_t>(subband.level) - 1);
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

DecodedGeometry decodeGeometry(const GeometryHeader& header, const Codewords& codewords,
                               std::vector<uint8_t> valid, uint32_t threads) {
  const uint32_t width = header.width, height = header.height;
  const WaveletSpec spec = specOf(header.wavelet);
  const PlaneLayout layout(spec, width, height);
  const std::vector<Region> regions = regionsOf(width, height, header.regions.side_log2);
  DecodedGeometry out;
  out.valid = std::move(valid);
  out.heights.resize(size_t{width} * height);
  out.significant.resize(out.heights.size());
  std::vector<uint32_t> quiet(regions.size(),
                              static_cast<uint32_t>(layout.subbands().front().level));
  const RegionDecoder tracks{header.wavelet, header.regions, header.planes, threads};
  out.fraction_bits = tracks.run(
      codewords, [&](size_t i) { return layout.plan(layout.parts(regions[i]), 0, 0, 0); },
      [&](size_t i, const TrackState& state, int more_bits) {
        const std::vector<BandPart> parts = layout.parts(regions[i]);
        for (size_t k = 0; k < parts.size(); ++k) {
          const Subband& subband = layout.subbands()[parts[k].subband];
          scatter(state.bands[k], more_bits, subband, parts[k], out.heights, width);
          markVertices(state.bands[k], subband, parts[k], width, out.significant);
        }
        quiet[i] = quietLevels(state, layout, parts);
      });
  out.quiet_levels = *std::min_element(quiet.begin(), quiet.end());
  inverseWavelet(spec, out.heights, width, height, out.valid, threads);
  clearVoids(out);
  return out;
}

DecodedGeometry decodeGeometryWindow(const GeometryHeader& header, const Codewords& codewords,
                                     std::span<const uint8_t> valid, const Window& window,
                                     uint32_t threads) {
  const WaveletSpec spec = specOf(header.wavelet);
  const PlaneLayout layout(spec, header.width, header.height);
  const std::vector<Region> regions =
      regionsOf(header.width, header.height, header.regions.side_log2);
  WindowSynthesis synthesis(spec, layout.subbands(), header.width, header.height, window);
  const RegionDecoder tracks{header.wavelet, header.regions, header.planes, threads};
  DecodedGeometry out;
  out.fraction_bits = tracks.run(
      codewords,
      [&](size_t i) {
        const std::vector<BandPart> parts = layout.parts(regions[i]);
        const bool needed = std::any_of(parts.begin(), parts.end(), [&](const BandPart& part) {
          return synthesis.needs(part);
        });
        return needed ? layout.plan(parts, 0, 0, 0) : std::vector<BandPlan>();
      },
      [&](size_t i, const TrackState& state, int more_bits) {
        const std::vector<BandPart> parts = layout.parts(regions[i]);
        for (size_t k = 0; k < parts.size(); ++k)
          synthesis.put(state.bands[k], more_bits, parts[k]);
      });
  out.heights = synthesis.run(valid);
  if (!valid.empty()) out.valid = crop(valid, header.width, window);
  for (size_t i = 0; i < out.valid.size(); ++i) out.heights[i] *= out.valid[i];
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
