// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/drawn_heights/drawn_heights_decoder.hpp"

#include "base/view.hpp"
#include "base/zeroed_array.hpp"
#include "codec/drawing/drawing_decoding.hpp"
#include "codec/drawing/drawing_pass.hpp"

namespace tetrakis::inline drawn_heights {

DecodedGeometry decodeDrawnHeights(const GeometryHeader& header, std::span<const uint8_t> codeword,
                                   const SharedBits& valid, const View& view) {
  const View grid{view.level, {}};
  const Extent extent = grid.extentIn(header.extent());
  const SharedBits shown = view.level > 0 ? sharedBits(shownMarks(valid, grid), extent) : valid;
  ZeroedArray<KeptIndex> indices(extent.samples());
  const PlaneView<KeptIndex> plane({indices.data(), indices.size()}, extent);
  const std::vector<Level> levels = levelsOf(header.width, header.height, view.level);
  DrawnSteps steps;
  DrawingDecoding<int32_t> io(codeword);
  if (!codeword.empty()) DrawingPass(plane, shown.get(), steps, io).run(levels);
  const Window window = view.window.value_or(Window{0, 0, extent.width, extent.height});
  return decodedHeights({plane.values(), extent, shown.get(), steps, levels, window});
}

DecodedGeometry decodedHeights(const DrawnSurface& surface) {
  DecodedGeometry out;
  out.width = surface.shown.width;
  out.height = surface.shown.height;
  out.fraction_bits = DrawnSurface::kFractionBits;
  if (surface.isWhole()) {
    out.heights.resize(surface.extent.samples());
    surface.fill(out.heights.data());
    out.significant = surface.significant(out.heights.data());
  } else {
    ZeroedArray<int32_t> heights(surface.extent.samples());  // few of which are touched
    surface.fill(heights.data());
    out.significant = surface.significant(heights.data());
    out.heights = slice(std::span<const int32_t>(heights.data(), heights.size()), surface.extent,
                        {0, surface.shown});
  }
  if (surface.valid != nullptr) out.valid = surface.valid->bytes({0, surface.shown});
  clearUnmarked(std::span(out.heights), out.valid);
  return out;
}

}  // namespace tetrakis::inline drawn_heights
