// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/encode_memory.hpp"

#include <algorithm>
#include <cstdint>

#include "apps/tools/files/memory_limit.hpp"

namespace tetrakis::tools {
namespace {

/// Cells that the bands of a transform of a plane take: their rows are padded to words of 32 and
/// two more, and have rows of margins around them. That counts where a plane is narrow or low.
uint64_t cellsOf(uint32_t width, uint32_t height) {
  constexpr uint64_t kWord = 32, kMarginColumns = 2, kMarginRows = 4;
  const auto cells = [](uint64_t rows, uint64_t columns) {
    if (rows == 0 || columns == 0) return uint64_t{0};
    return (rows + kMarginRows) * ((columns + kWord - 1) / kWord * kWord + kMarginColumns);
  };
  uint64_t all = 0;
  for (uint64_t columns = width, rows = height; columns > 1 || rows > 1;) {
    const uint64_t right = columns / 2, below = rows / 2;
    columns -= right;
    rows -= below;
    all += cells(rows, right) + cells(below, columns) + cells(below, right);
  }
  return std::max(all, uint64_t{width} * height);
}

/// Regions of a plane, at most: where their side is not given, it is no less than kChosen.
uint64_t regionsOf(const EncodeArguments& arguments, uint32_t width, uint32_t height) {
  constexpr uint32_t kChosen = 256, kLeast = 16;
  const Result<uint32_t> given = parseRegions(arguments.regions);
  const uint64_t side = given.ok() && *given > 1 ? std::max(*given, kLeast) : kChosen;
  return ((width + side - 1) / side) * ((height + side - 1) / side);
}

/// Measured: what encoding takes at most beside the samples, for each cell and each region.
struct EncodingBytes {
  uint64_t cell, region;
  uint64_t of(const EncodeArguments& arguments, uint32_t width, uint32_t height) const {
    return cell * cellsOf(width, height) + region * regionsOf(arguments, width, height);
  }
};

/// Most is taken by floats with voids that lie in a table, which are tried exactly as well. Within
/// a largest error several cuts of all heights are kept at a time; with a budget of triangles
/// prefixes are seen as the best mesh of all heights shows them.
EncodingBytes heightsTake(const EncodeArguments& arguments, bool beside_texture) {
  constexpr uint64_t kAlone = 32, kCompared = 50, kMeshes = 62, kRegion = 36 << 10;
  const bool compared = !arguments.max_error.empty() || (arguments.bytes > 0 && beside_texture);
  return {arguments.triangles > 0 ? kMeshes : compared ? kCompared : kAlone, kRegion};
}

}  // namespace

Status checkEncodeMemory(const EncodeArguments& arguments, const Reference& inputs) {
  constexpr EncodingBytes kTexelChannel = {18, 48 << 10};
  uint64_t bytes = 0;
  if (const auto& heights = inputs.heights) {
    bytes += heights->data.size() + heightsTake(arguments, inputs.image.has_value())
                                        .of(arguments, heights->width, heights->height);
  }
  if (const auto& image = inputs.image) {
    bytes += image->data.size() +
             image->channels * kTexelChannel.of(arguments, image->width, image->height);
  }
  return checkMemoryFor("encoding so many samples", bytes);
}

}  // namespace tetrakis::tools
