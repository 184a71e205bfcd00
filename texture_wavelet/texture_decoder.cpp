// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_decoder.hpp"

#include <algorithm>

#include "bitstream/track_decoder.hpp"
#include "texture_wavelet/texture_plan.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis {

namespace {

void interleave(const std::vector<int32_t>& plane, uint32_t channel, Texels& texels) {
  const int32_t most = (1 << texels.bits) - 1;
  for (size_t i = 0; i < plane.size(); ++i) {
    texels.samples[i * texels.channels + channel] = std::clamp(plane[i], 0, most);
  }
}

}  // namespace

Texels decodeTexture(const TextureHeader& header, std::span<const uint8_t> codeword) {
  Texels texels{header.width, header.height, header.channels, header.sample == TKS_U8 ? 8 : 16, {}};
  const size_t count = size_t{header.width} * header.height;
  const TexturePlan plan(header);
  const PlaneLayout& layout = plan.layout();
  const TrackState state = decodeTrack(plan.bands(), header.planes, codeword);
  const int fraction_bits = outputFractionBits(header.wavelet, header.planes, state.complete);
  std::vector<std::vector<int32_t>> planes(header.channels);
  std::vector<int32_t*> pointers;
  for (uint32_t c = 0; c < header.channels; ++c) {
    planes[c].assign(count, 0);
    for (size_t i = 0; i < layout.size(); ++i) {
      scatter(state.bands[c * layout.size() + i], fraction_bits - header.wavelet.fraction_bits,
              layout.subbands()[i], planes[c], header.width);
    }
    inverseWavelet(specOf(header.wavelet), planes[c], header.width, header.height);
    pointers.push_back(planes[c].data());
  }
  inverseColour(colourOf(header), pointers, count, fraction_bits);
  texels.samples.resize(count * header.channels);
  for (uint32_t c = 0; c < header.channels; ++c) interleave(planes[c], c, texels);
  return texels;
}

}  // namespace tetrakis
