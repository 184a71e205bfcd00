// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_decoder.hpp"

#include <algorithm>

#include "bitstream/track_decoder.hpp"
#include "texture_wavelet/texture_plan.hpp"

namespace tetrakis {

namespace {

/// Binary places that an incomplete track is reconstructed with, so that the inverse transforms add
/// no rounding noise of their own (texture_wavelet/wavelet.hpp).
int fractionBits(const TextureHeader& header, bool complete) {
  if (complete) return 0;
  return header.sample == TKS_U8 ? 4 : 1;
}

void scatter(const Band& band, const Subband& subband, int fraction_bits, uint32_t width,
             std::vector<int32_t>& plane) {
  if (!band.nonzero) return;
  for (uint32_t row = 0; row < subband.height; ++row) {
    const size_t first = band.shape.cell(row, 0);
    int32_t* to = plane.data() + size_t{subband.y + row} * width + subband.x;
    for (uint32_t column = 0; column < subband.width; ++column) {
      to[column] =
          static_cast<int32_t>(static_cast<uint32_t>(band.value(first + column)) << fraction_bits);
    }
  }
}

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
  const TrackState state = decodeTrack(plan.bands(), header.planes, plan, codeword);
  const int fraction_bits = fractionBits(header, state.complete);
  std::vector<std::vector<int32_t>> planes(header.channels);
  std::vector<int32_t*> pointers;
  for (uint32_t c = 0; c < header.channels; ++c) {
    planes[c].assign(count, 0);
    for (size_t b = 0; b < plan.bandsPerComponent(); ++b) {
      scatter(state.bands[c * plan.bandsPerComponent() + b], plan.subbands()[b], fraction_bits,
              header.width, planes[c]);
    }
    inverseWavelet(planes[c], header.width, header.height);
    pointers.push_back(planes[c].data());
  }
  inverseColour(colourOf(header), pointers, count, fraction_bits);
  texels.samples.resize(count * header.channels);
  for (uint32_t c = 0; c < header.channels; ++c) interleave(planes[c], c, texels);
  return texels;
}

}  // namespace tetrakis
