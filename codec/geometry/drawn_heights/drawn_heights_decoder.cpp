// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/drawn_heights/drawn_heights_decoder.hpp"

#include "base/view.hpp"
#include "codec/drawing/drawing_decoding.hpp"
#include "codec/drawing/drawing_pass.hpp"
#include "codec/geometry/drawn_heights/drawn_surface.hpp"

namespace tetrakis::inline drawn_heights {

DecodedGeometry decodeDrawnHeights(const GeometryHeader& header, std::span<const uint8_t> codeword,
                                   const std::vector<uint8_t>& valid, int level) {
  const View view{level, {}};
  const Extent extent = view.extentIn(header.extent());
  DecodedGeometry out;
  out.width = extent.width;
  out.height = extent.height;
  out.fraction_bits = DrawnSurface::kFractionBits;
  out.valid = slice(std::span<const uint8_t>(valid), header.extent(), view);
  std::vector<DrawnIndex> indices(extent.samples(), kNoIndex);
  const PlaneView<DrawnIndex> plane(indices, extent, out.valid);
  const std::vector<Level> levels = levelsOf(header.width, header.height, level);
  DrawnSteps steps;
  DrawingDecoding<int32_t> io(codeword);
  DrawingPass(plane, steps, io).run(levels);
  const DrawnSurface surface{plane, steps, levels};
  out.heights = surface.heights();
  out.significant = surface.significant(out.heights);
  clearUnmarked(std::span(out.heights), out.valid);
  return out;
}

}  // namespace tetrakis::inline drawn_heights
