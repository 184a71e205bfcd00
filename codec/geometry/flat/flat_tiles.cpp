// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/flat/flat_tiles.hpp"

#include <algorithm>
#include <array>

namespace tetrakis::inline flat {

namespace {

constexpr uint32_t kTileSide = 128;
/// Tiles that are taken of each kind.
constexpr std::array<size_t, 3> kMost = {8, 4, 4};
constexpr size_t kMostTiles = 16;

/// The tiles of a grid whose last row and column take what is left.
std::vector<Window> tilesOf(Extent plane) {
  const auto count = [](uint32_t side) { return std::max((side + kTileSide / 2) / kTileSide, 1u); };
  const uint32_t columns = count(plane.width), rows = count(plane.height);
  std::vector<Window> tiles;
  for (uint32_t row = 0; row < rows; ++row) {
    const uint32_t y = row * kTileSide;
    const uint32_t height = row + 1 < rows ? kTileSide : plane.height - y;
    for (uint32_t column = 0; column < columns; ++column) {
      const uint32_t x = column * kTileSide;
      tiles.push_back({x, y, column + 1 < columns ? kTileSide : plane.width - x, height});
    }
  }
  return tiles;
}

/// Takes at most so many of the tiles, at equal distances.
void takeEvenly(const std::vector<Window>& tiles, size_t most, std::vector<SampledTile>& taken) {
  const size_t count = std::min(tiles.size(), most), before = taken.size();
  double all = 0, some = 0;
  for (const Window& tile : tiles) all += static_cast<double>(tile.extent().samples());
  for (size_t i = 0; i < count; ++i) {
    taken.push_back({tiles[(2 * i + 1) * tiles.size() / (2 * count)], 0});
    some += static_cast<double>(taken.back().window.extent().samples());
  }
  for (size_t i = before; i < taken.size(); ++i) taken[i].stands_for = all / some;
}

}  // namespace

std::vector<SampledTile> sampleTiles(const FlatFinder& finder, uint32_t large, uint32_t small) {
  const Extent plane = finder.extent();
  const std::vector<Window> tiles = tilesOf(plane);
  if (tiles.size() <= kMostTiles) return {{{0, 0, plane.width, plane.height}, 1}};
  std::array<std::vector<Window>, kMost.size()> kinds;
  for (const Window& tile : tiles) {
    const uint64_t in_large = finder.samplesOf(large, tile);
    const bool shore = in_large > 0 && in_large < tile.extent().samples();
    const bool flat = in_large == 0 && finder.samplesOf(small, tile) > 0;
    kinds[shore ? 0 : flat ? 1 : 2].push_back(tile);
  }
  std::vector<SampledTile> taken;
  for (size_t kind = 0; kind < kinds.size(); ++kind) takeEvenly(kinds[kind], kMost[kind], taken);
  return taken;
}

}  // namespace tetrakis::inline flat
