// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn_decoder.hpp"

#include <algorithm>
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

 private:
  RangeDecoder decoder_;
  DrawnColour unknown_{};
};

Texels formatOf(const TextureHeader& header) {
  return {header.width, header.height, header.channels, header.sample == TKS_U8 ? 8 : 16, {}};
}

}  // namespace

Texels decodeDrawn(const TextureHeader& header, std::span<const uint8_t> codeword, int level) {
  Texels texels = formatOf(header);
  const size_t count = size_t{header.width} * header.height;
  std::vector<ColourIndex> indices(count, kNoColour);
  DrawnColours colours;
  DecodingIo io(codeword);
  const uint32_t step = uint32_t{1} << level;
  DrawnPass<DecodingIo>(texels, indices, colours, io).run(step);
  texels.samples.resize(count * header.channels);
  fillDrawn(indices, colours, step, texels);
  thin(step, texels);
  return texels;
}

DrawnOverlay decodeOverlay(const TextureHeader& header, std::span<const uint8_t> codeword) {
  DrawnOverlay overlay;
  const Texels format = formatOf(header);
  overlay.indices.assign(size_t{header.width} * header.height, kNoColour);
  overlay.colours.add(greyOf(format));
  DecodingIo io(codeword);
  DrawnPass<DecodingIo>(format, overlay.indices, overlay.colours, io).run();
  std::replace(overlay.indices.begin(), overlay.indices.end(), kNoColour, kSeeThrough);
  return overlay;
}

}  // namespace tetrakis
