// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/stored_texture.hpp"

#include <algorithm>

#include "bitstream/byte_planes.hpp"

namespace tetrakis {

Texels decodeStoredTexture(const TextureHeader& header, std::span<const uint8_t> codeword,
                           int level) {
  const int bits = header.sample == TKS_U8 ? 8 : 16;
  Texels texels{header.width, header.height, header.channels, bits, {}};
  const size_t count = size_t{header.width} * header.height * header.channels;
  const std::vector<uint32_t> words = fromBytePlanes(codeword, count, bits / 8);
  texels.samples.assign(count, static_cast<uint16_t>(1u << (bits - 1)));
  std::transform(words.begin(), words.end(), texels.samples.begin(),
                 [](uint32_t word) { return static_cast<uint16_t>(word); });
  thin(uint32_t{1} << level, texels);
  return texels;
}

}  // namespace tetrakis
