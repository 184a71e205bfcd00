// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/coefficients_encoder.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <span>

#include "base/parallel.hpp"
#include "base/portable_math.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/wavelet_header.hpp"

namespace tetrakis::inline geometry {

namespace {

/// A plane of transformed heights, with the parameters for coding its tracks.
struct Transformed {
  const PlaneLayout& layout;
  std::vector<int32_t> plane;
  double unit;  ///< squared steps in a squared unit of coefficients
  std::array<double, kPriorities> worth;

  TrackSource sourceOf(const Region& region) const {
    const std::vector<BandPart> parts = layout.parts(region);
    TrackSource source;
    source.plan = layout.marked(parts, layout.plan(parts));
    for (size_t k = 0; k < parts.size(); ++k) {
      source.bands.push_back(
          {layout.gather(plane, parts[k]), layout.energy(parts[k].subband) * unit, worth});
      clearAbsent(source.plan[k], source.bands[k].values);
    }
    return source;
  }
};

std::vector<int32_t> transformed(const PlaneView<const int32_t>& heights,
                                 const WaveletHeader& wavelet, const PlaneLayout& layout,
                                 uint32_t threads) {
  std::vector<int32_t> plane = withFractions(heights.values(), wavelet.fraction_bits);
  clearUnmarked(std::span(plane), heights.valid);
  forwardWavelet(specOf(wavelet), layout.pyramid(), plane, threads);
  return plane;
}

}  // namespace

std::vector<EncodedTrack> encodeCoefficients(const PlaneView<const int32_t>& heights,
                                             const WaveletHeader& wavelet,
                                             const CoefficientOptions& options) {
  static const FlatAreas kNone;
  static const PriorityMap kAlike;
  const FlatAreas& flat = options.flat == nullptr ? kNone : *options.flat;
  const PriorityMap& priorities = options.priorities == nullptr ? kAlike : *options.priorities;
  const std::vector<int32_t> areas = withFractions(flat.heights, wavelet.fraction_bits);
  const PlaneLayout layout(
      specOf(wavelet), Pyramid(heights.extent(), heights.valid, {flat.numbers, areas}), priorities);
  Transformed of{layout, transformed(heights, wavelet, layout, options.threads),
                 options.share * portable::exp2(-2 * wavelet.fraction_bits), worthOf(priorities)};
  const std::vector<Region> regions = regionsOf(heights.width, heights.height, options.region_log2);
  assert(!regions.empty());
  const auto source_of = [&](size_t region) { return of.sourceOf(regions[region]); };
  const TrackOptions tracks{options.limit, options.threads, options.enough};
  if (regions.size() > 1 && tracks.toTheEnd())
    return encodeWholeTracks(regions.size(), source_of, options.threads);
  std::vector<TrackSource> sources(regions.size());
  parallelFor(options.threads, sources.size(), [&](size_t i) { sources[i] = source_of(i); });
  of.plane = std::vector<int32_t>();  // {} would keep its memory
  return encodeTracks(sources, tracks);
}

}  // namespace tetrakis::inline geometry
