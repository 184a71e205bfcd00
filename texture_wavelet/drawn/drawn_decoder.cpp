// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn/drawn_decoder.hpp"

#include <algorithm>
#include <vector>

#include "bitstream/coder/range_decoder.hpp"
#include "texture_wavelet/drawn/drawn_fill.hpp"
#include "texture_wavelet/drawn/drawn_pass.hpp"

namespace tetrakis::inline drawn {

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

/// Every 2^level-th texel is a grid of its own: no vertex needs one of a finer level.
Texels decodeDrawn(const TextureHeader& header, std::span<const uint8_t> codeword, int level) {
  const std::vector<Level> levels = levelsOf(header.width, header.height, level);
  Texels texels = formatOf(header);
  texels.width = ((header.width - 1) >> level) + 1;
  texels.height = ((header.height - 1) >> level) + 1;
  const size_t count = size_t{texels.width} * texels.height;
  std::vector<ColourIndex> indices(count, kNoColour);
  DrawnColours colours;
  DecodingIo io(codeword);
  DrawnPass<DecodingIo>(texels, indices, colours, io).run(levels);
  texels.samples.resize(count * header.channels);
  fillDrawn(levels, indices, colours, texels);
  return texels;
}

DrawnOverlay decodeOverlay(const TextureHeader& header, std::span<const uint8_t> codeword) {
  DrawnOverlay overlay;
  const Texels format = formatOf(header);
  overlay.indices.assign(size_t{header.width} * header.height, kNoColour);
  overlay.colours.add(greyOf(format));
  DecodingIo io(codeword);
  DrawnPass<DecodingIo>(format, overlay.indices, overlay.colours, io)
      .run(levelsOf(header.width, header.height));
  std::replace(overlay.indices.begin(), overlay.indices.end(), kNoColour, kSeeThrough);
  return overlay;
}

}  // namespace tetrakis::inline drawn
