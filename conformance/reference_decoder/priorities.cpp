// SPDX-License-Identifier: Apache-2.0
// Reference decoder: maps of priorities (docs/FORMAT.md, section 5.2).
#include <algorithm>
#include <bit>
#include <cstdlib>

#include "conformance/reference_decoder/range_decoder.hpp"
#include "conformance/reference_decoder/regions.hpp"

namespace tetrakis::reference {
namespace {

/// FORMAT 5.2, the decisions of a tile.
class TileDecoder {
 public:
  explicit TileDecoder(std::span<const uint8_t> code) : decoder_(code) {}

  int tile(int west, int north, int beyond) {
    const int expected =
        std::clamp(west + north - beyond, std::min(west, north), std::max(west, north));
    const int d = std::min(2, std::abs(west - beyond) + std::abs(north - beyond));
    if (same_[d].decode(decoder_)) return expected;
    bool up = expected == 0;
    if (expected > 0 && expected < 7) up = up_[d].decode(decoder_);
    const int most = up ? 7 - expected : expected;
    const int off = 1 + ones(most - 1, [&](int i) { return more_[i + 1].decode(decoder_); });
    return up ? expected + off : expected - off;
  }

 private:
  RangeDecoder decoder_;
  Model same_[3], up_[3], more_[8];
};

/// FORMAT 5.2, the priority of a coefficient of a level whose sample is (x, y).
int priorityAt(const PriorityMap& map, int x, int y, int level) {
  const int64_t reach = (int64_t{1} << level) / 2;
  const int left = static_cast<int>(std::max<int64_t>(x - reach, 0) >> map.tileLog2);
  const int top = static_cast<int>(std::max<int64_t>(y - reach, 0) >> map.tileLog2);
  const int right = static_cast<int>(std::min<int64_t>(x + reach, map.width - 1) >> map.tileLog2);
  const int bottom = static_cast<int>(std::min<int64_t>(y + reach, map.height - 1) >> map.tileLog2);
  uint64_t sum = 0, count = 0;
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column, ++count)
      sum += uint64_t{1} << (2 * map.tiles[size_t(row) * map.columns() + column]);
  }
  return (static_cast<int>(std::bit_width(2 * (sum / count))) - 1) / 2;
}

}  // namespace

PriorityMap priorityMapOf(const PriorityHeader& header, int width, int height) {
  PriorityMap map{width, height, header.tileLog2, {}};
  if (header.tileLog2 == 0) return map;
  const int columns = map.columns();
  map.tiles.resize(size_t(columns) * map.rows());
  TileDecoder decoder(header.code);
  const auto at = [&](int row, int column) { return map.tiles[size_t(row) * columns + column]; };
  try {
    for (int y = 0; y < map.rows(); ++y) {
      for (int x = 0; x < columns; ++x) {
        int west = x > 0 ? at(y, x - 1) : 0;
        const int north = y > 0 ? at(y - 1, x) : west;
        if (x == 0) west = north;
        const int beyond = x > 0 && y > 0 ? at(y - 1, x - 1) : north;
        map.tiles[size_t(y) * columns + x] = decoder.tile(west, north, beyond);
      }
    }
  } catch (Undecided) {
  }
  return map;
}

void setPriorities(const std::vector<Part>& parts, const PriorityMap& map, std::span<Band> bands) {
  if (map.tiles.empty()) return;
  for (size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    for (int r = 0; r < part.rows; ++r) {
      for (int a = 0; a < part.columns; ++a)
        bands[i].at(r, a).priority = priorityAt(map, part.x(a), part.y(r), part.subband.level);
    }
  }
}

}  // namespace tetrakis::reference
