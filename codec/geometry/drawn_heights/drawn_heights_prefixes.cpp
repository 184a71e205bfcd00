// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/drawn_heights/drawn_heights_prefixes.hpp"

#include <memory>
#include <utility>

#include "codec/drawing/drawing_prefixes.hpp"
#include "codec/geometry/drawn_heights/drawn_heights_decoder.hpp"

namespace tetrakis::inline drawn_heights {

namespace {

using HeightPrefixes = DrawingPrefixes<DrawnSteps, int32_t>;

}  // namespace

std::function<DecodedGeometry(uint64_t bytes)> prefixesOfDrawing(const GeometryHeader& header,
                                                                 std::span<const uint8_t> codeword,
                                                                 Mask valid) {
  const Extent extent = header.extent();
  const SharedBits marks = sharedBits(valid, extent);
  std::vector<Level> levels = levelsOf(extent.width, extent.height);
  const auto prefixes =
      std::make_shared<HeightPrefixes>(codeword, extent, marks.get(), levels, DrawnSteps());
  const Window whole{0, 0, extent.width, extent.height};
  return [=, levels = std::move(levels)](uint64_t bytes) {
    return decodedHeights(
        {prefixes->indicesAfter(bytes), extent, marks.get(), prefixes->list(), levels, whole});
  };
}

}  // namespace tetrakis::inline drawn_heights
