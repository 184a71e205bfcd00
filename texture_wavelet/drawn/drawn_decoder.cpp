// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn/drawn_decoder.hpp"

#include <algorithm>
#include <vector>

#include "codec/drawing/drawing_decoding.hpp"
#include "codec/drawing/drawing_pass.hpp"
#include "texture_wavelet/drawn/drawn_fill.hpp"

namespace tetrakis::inline drawn {

namespace {

using ColourDecoding = DrawingDecoding<DrawnColour>;

}  // namespace

Texels formatOf(const TextureHeader& header) {
  return {header.width, header.height, header.channels,   header.sample == TKS_U8 ? 8 : 16,
          {},           header.opaque, header.white_level};
}

DrawnColours overlayColours(const Texels& format) {
  DrawnColours colours(format);
  colours.add(greyOf(format));
  return colours;
}

/// Every 2^level-th texel is a grid of its own: no vertex needs one of a finer level.
Texels decodeDrawn(const TextureHeader& header, std::span<const uint8_t> codeword, int level) {
  const std::vector<Level> levels = levelsOf(header.width, header.height, level);
  Texels texels = formatOf(header);
  const Extent extent = View{level, {}}.extentIn(header.extent());
  texels.width = extent.width;
  texels.height = extent.height;
  std::vector<DrawnIndex> indices(extent.samples(), kNoIndex);
  DrawnColours colours(texels);
  ColourDecoding io(codeword);
  DrawingPass(PlaneView<DrawnIndex>(indices, extent), colours, io).run(levels);
  texels.samples.resize(extent.samples() * header.channels);
  fillDrawn(levels, indices, colours, texels);
  return texels;
}

DrawnOverlay decodeOverlay(const TextureHeader& header, std::span<const uint8_t> codeword) {
  DrawnOverlay overlay{{}, overlayColours(formatOf(header))};
  overlay.indices.assign(header.extent().samples(), kNoIndex);
  ColourDecoding io(codeword);
  DrawingPass(PlaneView<DrawnIndex>(overlay.indices, header.extent()), overlay.colours, io)
      .run(levelsOf(header.width, header.height));
  std::replace(overlay.indices.begin(), overlay.indices.end(), kNoIndex, kSeeThrough);
  return overlay;
}

}  // namespace tetrakis::inline drawn
