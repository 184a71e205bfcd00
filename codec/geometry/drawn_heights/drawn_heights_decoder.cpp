// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/drawn_heights/drawn_heights_decoder.hpp"

#include <utility>

#include "base/view.hpp"
#include "codec/drawing/drawing_decoding.hpp"
#include "codec/drawing/drawing_pass.hpp"

namespace tetrakis::inline drawn_heights {

DecodedGeometry decodeDrawnHeights(const GeometryHeader& header, std::span<const uint8_t> codeword,
                                   const std::vector<uint8_t>& valid, int level) {
  const View view{level, {}};
  const Extent extent = view.extentIn(header.extent());
  std::vector<uint8_t> shown = slice(std::span<const uint8_t>(valid), header.extent(), view);
  std::vector<DrawnIndex> indices(extent.samples(), kNoIndex);
  const PlaneView<DrawnIndex> plane(indices, extent, shown);
  const std::vector<Level> levels = levelsOf(header.width, header.height, level);
  DrawnSteps steps;
  DrawingDecoding<int32_t> io(codeword);
  if (!codeword.empty()) DrawingPass(plane, steps, io).run(levels);
  return decodedHeights({plane, steps, levels}, std::move(shown));
}

DecodedGeometry decodedHeights(const DrawnSurface& surface, std::vector<uint8_t> valid) {
  DecodedGeometry out;
  out.width = surface.indices.width;
  out.height = surface.indices.height;
  out.fraction_bits = DrawnSurface::kFractionBits;
  out.heights = surface.heights();
  out.significant = surface.significant(out.heights);
  out.valid = std::move(valid);
  clearUnmarked(std::span(out.heights), out.valid);
  return out;
}

}  // namespace tetrakis::inline drawn_heights
