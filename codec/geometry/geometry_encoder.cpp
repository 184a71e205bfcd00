// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/geometry_encoder.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <span>

#include "base/parallel.hpp"
#include "wavelet/band_plan.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis::inline geometry {

std::vector<EncodedTrack> encodeCoefficients(const PlaneView<const int32_t>& heights,
                                             const WaveletHeader& wavelet,
                                             const CoefficientOptions& options) {
  const std::span<const int32_t> given = heights.values();
  std::vector<int32_t> plane(given.begin(), given.end());
  for (int32_t& h : plane) {
    h = static_cast<int32_t>(static_cast<uint32_t>(h) << wavelet.fraction_bits);
  }
  clearUnmarked(std::span(plane), heights.valid);
  const WaveletSpec spec = specOf(wavelet);
  static const FlatAreas kNone;
  const FlatAreas& flat = options.flat == nullptr ? kNone : *options.flat;
  std::vector<int32_t> area_heights = flat.heights;
  for (int32_t& h : area_heights)
    h = static_cast<int32_t>(static_cast<uint32_t>(h) << wavelet.fraction_bits);
  static const PriorityMap kAlike;
  const PriorityMap& priorities = options.priorities == nullptr ? kAlike : *options.priorities;
  const PlaneLayout layout(spec, heights.extent(), heights.valid, {flat.numbers, area_heights},
                           priorities);
  forwardWavelet(spec, layout.pyramid(), plane, options.threads);
  const double unit = std::exp2(-2 * wavelet.fraction_bits);
  const std::array<double, kPriorities> worth = worthOf(priorities);
  const std::vector<Region> regions = regionsOf(heights.width, heights.height, options.region_log2);
  assert(!regions.empty());
  const auto source_of = [&](size_t region) {
    const std::vector<BandPart> parts = layout.parts(regions[region]);
    TrackSource track;
    track.plan = layout.plan(parts, 0, 0, 0);
    layout.markAbsent(parts, track.plan);
    layout.markTiers(parts, track.plan);
    for (size_t k = 0; k < parts.size(); ++k) {
      track.bands.push_back(
          {layout.gather(plane, parts[k]), layout.energy(parts[k].subband) * unit, worth});
      clearAbsent(track.plan[k], track.bands[k].values);
    }
    return track;
  };
  const TrackOptions tracks{options.limit, options.threads, options.enough};
  if (regions.size() > 1 && tracks.toTheEnd())
    return encodeWholeTracks(regions.size(), source_of, options.threads);
  std::vector<TrackSource> sources(regions.size());
  parallelFor(options.threads, sources.size(), [&](size_t i) { sources[i] = source_of(i); });
  plane = std::vector<int32_t>();  // {} would keep its memory
  return encodeTracks(sources, tracks);
}

}  // namespace tetrakis::inline geometry
