// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/stored_texture_decoder.hpp"

#include "bitstream/coder/byte_planes.hpp"

namespace tetrakis::inline texture {

Texels decodeStoredTexture(const TextureHeader& header, std::span<const uint8_t> codeword,
                           int level) {
  const int bits = header.sample == TKS_U8 ? 8 : 16;
  const uint32_t channels = header.channels, step = uint32_t{1} << level;
  Texels texels{(header.width - 1) / step + 1,
                (header.height - 1) / step + 1,
                channels,
                bits,
                {},
                header.opaque,
                header.white_level};
  const BytePlanes words(codeword, size_t{header.width} * header.height * channels, bits / 8);
  const auto unknown = static_cast<uint16_t>((texels.white() + 1) / 2);
  texels.samples.reserve(size_t{texels.width} * texels.height * channels);
  for (uint32_t y = 0; y < header.height; y += step) {
    for (uint32_t x = 0; x < header.width; x += step) {
      const size_t first = (size_t{y} * header.width + x) * channels;
      for (size_t i = first; i < first + channels; ++i)
        texels.samples.push_back(words.knows(i) ? static_cast<uint16_t>(words[i]) : unknown);
    }
  }
  return texels;
}

}  // namespace tetrakis::inline texture
