// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry_encoder.hpp"

#include <cmath>

#include "wavelet/band_plan.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis {

EncodedTrack encodeGeometry(std::span<const int32_t> heights, uint32_t width, uint32_t height,
                            const WaveletHeader& wavelet, uint64_t limit,
                            std::span<const uint8_t> valid) {
  std::vector<int32_t> plane(heights.begin(), heights.end());
  for (int32_t& h : plane) {
    h = static_cast<int32_t>(static_cast<uint32_t>(h) << wavelet.fraction_bits);
  }
  for (size_t i = 0; i < valid.size(); ++i) plane[i] *= valid[i];
  const WaveletSpec spec = specOf(wavelet);
  forwardWavelet(spec, plane, width, height, valid);
  const PlaneLayout layout(spec, width, height);
  const double unit = std::exp2(-2 * wavelet.fraction_bits);
  std::vector<BandSource> sources;
  for (size_t i = 0; i < layout.size(); ++i) {
    sources.push_back({gather(plane, width, layout.subbands()[i]), layout.energy(i) * unit});
  }
  std::vector<BandPlan> plan = layout.plan(0, 0, 0);
  markAbsent(layout, valid, width, plan);
  return encodeTrack(plan, sources, limit);
}

}  // namespace tetrakis
