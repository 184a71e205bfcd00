// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/heights_encoder.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <span>

#include "base/parallel.hpp"
#include "base/portable_math.hpp"
#include "base/samples.hpp"
#include "bitstream/coder/byte_planes.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/wavelet.hpp"

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
  const WaveletSpec spec = specOf(wavelet);
  const Extent extent = heights.extent();
  const PlaneLayout layout(
      spec, pyramidOf(spec, sharedBits(heights.valid, extent), extent, {flat.numbers, areas}),
      priorities);
  Transformed of{layout, transformed(heights, wavelet, layout, options.threads),
                 options.share * portable::exp2(-2 * wavelet.fraction_bits), worthOf(priorities)};
  const std::vector<Region> regions =
      regionsOf(heights.width, heights.height, options.region_log2, wavelet.patches());
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

uint64_t storedBytes(const tks_heights& heights, size_t valid_samples) {
  return uint64_t{valid_samples} * tks_sample_bytes(heights.sample);
}

std::vector<uint8_t> encodeStoredHeights(const tks_heights& heights, Mask valid) {
  std::vector<uint32_t> words;
  withSampleType(heights.sample, [&](auto type) {
    const auto* samples = static_cast<const decltype(type)*>(heights.data);
    for (size_t i = 0; i < size_t{heights.width} * heights.height; ++i) {
      if (valid[i]) words.push_back(orderOf(samples[i]));
    }
  });
  return toBytePlanes(words, static_cast<int>(tks_sample_bytes(heights.sample)));
}

}  // namespace tetrakis::inline geometry
