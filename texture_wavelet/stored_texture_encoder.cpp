// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_encoder.hpp"

#include <span>
#include <utility>

#include "bitstream/coder/byte_planes.hpp"
#include "texture_wavelet/mask/mask.hpp"
#include "texture_wavelet/texture_decoder.hpp"

namespace tetrakis::inline texture {

uint64_t storedBytes(const Texels& texels) {
  return texels.samples.size() * static_cast<uint64_t>(texels.bits / 8);
}

EncodedTexture encodeStoredTexture(const Texels& texels) {
  EncodedTexture encoded;
  TextureHeader& header = encoded.header;
  header.width = texels.width;
  header.height = texels.height;
  header.channels = static_cast<uint8_t>(texels.channels);
  header.opaque = texels.opaque;
  header.white_level = texels.white_level;
  header.sample = texels.bits == 8 ? TKS_U8 : TKS_U16;
  header.planes = kDrawnPlanes;
  header.stored = true;
  EncodedTrack& track = encoded.tracks.emplace_back();
  track.codeword = toBytePlanes(std::vector<uint32_t>(texels.samples.begin(), texels.samples.end()),
                                texels.bits / 8);
  track.planes = kDrawnPlanes;
  for (uint64_t bytes = 0; bytes <= track.codeword.size(); bytes += texels.samples.size()) {
    const Texels decoded = decodeStoredTexture(header, std::span(track.codeword).first(bytes), {});
    const double squares = countedSquares(texels, decoded, {});
    const bool last = bytes == track.codeword.size();
    if (track.points.empty() || last || squares < track.points.back().distortion)
      track.points.push_back({bytes, squares});
  }
  return encoded;
}

}  // namespace tetrakis::inline texture
