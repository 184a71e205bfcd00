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
                                                                 std::vector<uint8_t> valid) {
  const Extent extent = header.extent();
  std::vector<Level> levels = levelsOf(extent.width, extent.height);
  const auto prefixes =
      std::make_shared<HeightPrefixes>(codeword, extent, valid, levels, DrawnSteps());
  return [=, levels = std::move(levels), valid = std::move(valid)](uint64_t bytes) {
    const PlaneView<const DrawnIndex> plane(prefixes->indicesAfter(bytes), extent, valid);
    return decodedHeights({plane, prefixes->list(), levels}, valid);
  };
}

}  // namespace tetrakis::inline drawn_heights
