// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/stored_texture_decoder.hpp"

#include "bitstream/coder/byte_planes.hpp"

namespace tetrakis::inline texture {

Texels decodeStoredTexture(const TextureHeader& header, std::span<const uint8_t> codeword,
                           const View& view) {
  const int bits = header.sampleBits();
  const uint32_t channels = header.channels;
  const Extent extent = view.extentIn(header.extent());
  Texels texels{extent.width, extent.height, channels, bits, {}, header.opaque, header.white_level};
  const BytePlanes words(codeword, header.extent().samples() * channels, bits / 8);
  const auto unknown = static_cast<uint16_t>((texels.white() + 1) / 2);
  texels.samples.reserve(extent.samples() * channels);
  for (uint32_t y = 0; y < extent.height; ++y) {
    const size_t row = (view.firstRow() + size_t{y} * view.step()) * header.width;
    for (uint32_t x = 0; x < extent.width; ++x) {
      const size_t first = (row + view.firstColumn() + size_t{x} * view.step()) * channels;
      for (size_t i = first; i < first + channels; ++i)
        texels.samples.push_back(words.knows(i) ? static_cast<uint16_t>(words[i]) : unknown);
    }
  }
  return texels;
}

}  // namespace tetrakis::inline texture
