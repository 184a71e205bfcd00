// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn_decoder.hpp"

#include <vector>

#include "bitstream/range_decoder.hpp"
#include "texture_wavelet/drawn_fill.hpp"
#include "texture_wavelet/drawn_pass.hpp"

namespace tetrakis {

namespace {

class DecodingIo {
 public:
  explicit DecodingIo(std::span<const uint8_t> codeword) : decoder_(codeword) {}
  ColourIndex target(size_t) const { return kNoColour; }
  const DrawnColour& colour(size_t) const { return unknown_; }
  bool bit(AdaptiveBit& model, bool) { return decoder_.decode(model); }
  bool evenBit(bool) { return decoder_.decodeEven(); }
  bool stopped() const { return decoder_.exhausted(); }
  void levelDone(const Level&) {}

 private:
  RangeDecoder decoder_;
  DrawnColour unknown_{};
};

}  // namespace

Texels decodeDrawn(const TextureHeader& header, std::span<const uint8_t> codeword) {
  Texels texels{header.width, header.height, header.channels, header.sample == TKS_U8 ? 8 : 16, {}};
  const size_t count = size_t{header.width} * header.height;
  std::vector<ColourIndex> indices(count, kNoColour);
  DrawnColours colours;
  DecodingIo io(codeword);
  DrawnPass<DecodingIo>(texels, indices, colours, io).run();
  texels.samples.resize(count * header.channels);
  fillDrawn(indices, colours, texels);
  return texels;
}

}  // namespace tetrakis
