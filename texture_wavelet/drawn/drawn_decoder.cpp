// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn/drawn_decoder.hpp"

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
Texels decodeDrawn(const TextureHeader& header, std::span<const uint8_t> codeword,
                   const View& view) {
  const std::vector<Level> levels = levelsOf(header.width, header.height, view.level);
  Texels texels = formatOf(header);
  const Extent grid = View{view.level, {}}.extentIn(header.extent());
  const Extent extent = view.extentIn(header.extent());
  texels.width = extent.width;
  texels.height = extent.height;
  ZeroedArray<KeptIndex> kept(grid.samples());
  const std::span<KeptIndex> indices(kept.data(), kept.size());
  DrawnColours colours(texels);
  ColourDecoding io(codeword);
  DrawingPass(PlaneView<KeptIndex>(indices, grid), nullptr, colours, io).run(levels);
  if (view.window) {
    fillDrawn(levels, indices, colours, grid, *view.window, texels);
  } else {
    texels.samples.resize(extent.samples() * header.channels);
    fillDrawn(levels, indices, colours, texels);
  }
  return texels;
}

DrawnOverlay decodeOverlay(const TextureHeader& header, std::span<const uint8_t> codeword) {
  DrawnOverlay overlay{ZeroedArray<KeptIndex>(header.extent().samples()), 1,
                       overlayColours(formatOf(header))};
  const PlaneView<KeptIndex> plane({overlay.indices.data(), overlay.indices.size()},
                                   header.extent());
  ColourDecoding io(codeword);
  overlay.step =
      DrawingPass(plane, nullptr, overlay.colours, io).run(levelsOf(header.width, header.height));
  return overlay;
}

}  // namespace tetrakis::inline drawn
