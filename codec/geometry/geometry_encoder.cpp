// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/geometry_encoder.hpp"

#include <cassert>
#include <cmath>

#include "base/parallel.hpp"
#include "wavelet/band_plan.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis {

std::vector<EncodedTrack> encodeCoefficients(const HeightPlane& source,
                                             const WaveletHeader& wavelet,
                                             const CoefficientOptions& options) {
  const std::span<const int32_t> heights = source.heights;
  const std::span<const uint8_t> valid = source.valid;
  const uint32_t width = source.width, height = source.height;
  assert(heights.size() == size_t{width} * height);
  assert(valid.empty() || valid.size() == heights.size());
  std::vector<int32_t> plane(heights.begin(), heights.end());
  for (int32_t& h : plane) {
    h = static_cast<int32_t>(static_cast<uint32_t>(h) << wavelet.fraction_bits);
  }
  for (size_t i = 0; i < valid.size(); ++i) plane[i] *= valid[i];
  const WaveletSpec spec = specOf(wavelet);
  forwardWavelet(spec, plane, width, height, valid, options.threads);
  const PlaneLayout layout(spec, width, height);
  const double unit = std::exp2(-2 * wavelet.fraction_bits);
  const std::vector<Region> regions = regionsOf(width, height, options.region_log2);
  assert(!regions.empty());
  std::vector<TrackSource> tracks(regions.size());
  parallelFor(options.threads, regions.size(), [&](size_t i) {
    const std::vector<BandPart> parts = layout.parts(regions[i]);
    TrackSource& track = tracks[i];
    track.plan = layout.plan(parts, 0, 0, 0);
    markAbsent(layout, parts, valid, width, track.plan);
    for (const BandPart& part : parts) {
      track.bands.push_back({gather(plane, width, layout.subbands()[part.subband], part),
                             layout.energy(part.subband) * unit});
    }
  });
  return encodeTracks(tracks, {options.limit, options.threads});
}

}  // namespace tetrakis
