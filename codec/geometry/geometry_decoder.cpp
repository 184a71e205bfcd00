// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/geometry_decoder.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

#include "wavelet/band_plan.hpp"
#include "wavelet/mip_level.hpp"
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

uint32_t quietLevels(const TrackState& state, std::span<const Subband> subbands,
                     std::span<const BandPart> parts) {
  auto quiet = static_cast<uint32_t>(subbands.front().level);
  for (size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].subband >= subbands.size() || !state.bands[i].nonzero) continue;
    const Subband& subband = subbands[parts[i].subband];
    if (subband.orientation == Orientation::kLL) continue;
    quiet = std::min(quiet, static_cast<uint32_t>(subband.level) - 1);
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

/// What a track of the plan holds, and which bands of it a level needs; empty: none.
std::vector<BandPlan> planOf(const PlaneLayout& layout, std::span<const BandPart> parts,
                             Validity valid, uint32_t width, const MipLevel& mip) {
  std::vector<BandPlan> plan = layout.plan(parts, 0, 0, 0);
  mip.dropFiner(parts, plan);
  const auto needed = [](const BandPlan& band) { return band.needed; };
  if (std::none_of(plan.begin(), plan.end(), needed)) return {};
  markAbsent(layout, parts, valid, width, plan);
  return plan;
}

}  // namespace

DecodedGeometry decodeGeometry(const GeometryHeader& header, const Codewords& codewords,
                               std::vector<uint8_t> valid, int level, uint32_t threads,
                               TrackMemory* memory) {
  const WaveletSpec spec = specOf(header.wavelet);
  const PlaneLayout layout(spec, header.width, header.height);
  const std::vector<Region> regions =
      regionsOf(header.width, header.height, header.regions.side_log2);
  assert(codewords.size() == regions.size());
  assert(valid.empty() || valid.size() == size_t{header.width} * header.height);
  const MipLevel mip(header.width, header.height, level);
  const auto [width, height] = mip.low();
  const uint32_t low_width = width;
  const std::vector<Subband> subbands = subbandsOf(width, height);
  DecodedGeometry out;
  out.heights.resize(size_t{width} * height);
  out.significant.resize(out.heights.size());
  std::vector<uint32_t> quiet(regions.size(), static_cast<uint32_t>(subbands.front().level));
  const RegionDecoder tracks{header.wavelet, header.regions, header.planes, threads};
  out.fraction_bits = tracks.run(
      codewords,
      [&](size_t i) { return planOf(layout, layout.parts(regions[i]), valid, header.width, mip); },
      [&](size_t i, const TrackState& state, int more_bits) {
        const std::vector<BandPart> parts = layout.parts(regions[i]);
        for (size_t k = 0; k < parts.size(); ++k) {
          if (parts[k].subband >= subbands.size()) continue;
          const Subband& subband = subbands[parts[k].subband];
          scatter(state.bands[k], more_bits, subband, parts[k], out.heights, low_width);
          markVertices(state.bands[k], subband, parts[k], low_width, out.significant);
        }
        quiet[i] = quietLevels(state, subbands, parts);
      },
      memory);
  assert(!quiet.empty());
  out.quiet_levels = *std::min_element(quiet.begin(), quiet.end());
  out.valid = level == 0 ? std::move(valid) : mip.maskOf(valid, header.width);
  inverseWavelet(mip.transform(spec), out.heights, width, height, out.valid, threads);
  clearVoids(out);
  mip.normalise(spec, out.heights);
  thin(mip, out.heights);
  thin(mip, out.significant);
  if (!out.valid.empty()) thin(mip, out.valid);
  out.width = mip.size().width;
  out.height = mip.size().height;
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
  synthesis.allocate();
  const RegionDecoder tracks{header.wavelet, header.regions, header.planes, threads};
  DecodedGeometry out;
  out.fraction_bits = tracks.run(
      codewords,
      [&](size_t i) {
        const std::vector<BandPart> parts = layout.parts(regions[i]);
        const bool needed = std::any_of(parts.begin(), parts.end(), [&](const BandPart& part) {
          return synthesis.needs(part);
        });
        if (!needed) return std::vector<BandPlan>();
        return planOf(layout, parts, valid, header.width, MipLevel(header.width, header.height, 0));
      },
      [&](size_t i, const TrackState& state, int more_bits) {
        const std::vector<BandPart> parts = layout.parts(regions[i]);
        for (size_t k = 0; k < parts.size(); ++k)
          synthesis.put(state.bands[k], more_bits, parts[k]);
      });
  out.heights = synthesis.run(valid);
  if (!valid.empty()) out.valid = crop(valid, header.width, window);
  for (size_t i = 0; i < out.valid.size(); ++i) out.heights[i] *= out.valid[i];
  out.width = window.width;
  out.height = window.height;
  return out;
}

std::vector<int32_t> wholeSteps(const DecodedGeometry& decoded) {
  std::vector<int32_t> steps = decoded.heights;
  for (int32_t& q : steps) q = wholeStep(q, decoded.fraction_bits);
  return steps;
}

}  // namespace tetrakis
