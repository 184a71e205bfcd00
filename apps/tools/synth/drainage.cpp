// SPDX-License-Identifier: Apache-2.0
// Water takes the steepest way down between the levels to which depressions fill. Level ground is
// flooded from the cells that drain (Barnes, Lehman, Mulla, "Priority-flood", Computers &
// Geosciences 62, 2014), so that each cell there is reached.
#include "apps/tools/synth/drainage.hpp"

#include <functional>
#include <limits>
#include <queue>
#include <tuple>

#include "apps/tools/synth/basins.hpp"

namespace tetrakis::tools::synth {
namespace {

constexpr uint32_t kNoCell = std::numeric_limits<uint32_t>::max();

uint32_t lowestCell(const Grid& height) {
  uint32_t lowest = 0;
  for (uint32_t cell = 1; cell < height.size(); ++cell)
    if (height[cell] < height[lowest]) lowest = cell;
  return lowest;
}

/// kNoCell where no neighbour is lower.
Raster<uint32_t> steepestDescent(const Grid& level, const Raster<uint8_t>& outlet) {
  return rasterOf<uint32_t>(level.side(), [&](uint32_t x, uint32_t y) {
    const uint32_t cell = y * level.side() + x;
    if (outlet[cell]) return cell;
    double steepest = 0;
    uint32_t receiver = kNoCell;
    forNeighbours(level, cell, [&](uint32_t next, const Step& step) {
      const double slope = (level[cell] - level[next]) / step.length;
      if (slope > steepest) {
        steepest = slope;
        receiver = next;
      }
    });
    return receiver;
  });
}

/// A cell that the flood has reached. The order is total, so ties fall the same way everywhere; on
/// flats a hash decides, which lets rivers wander there instead of following the raster.
struct Front {
  double level;
  uint32_t lot, cell;

  bool operator>(const Front& other) const {
    return std::tie(level, lot, cell) > std::tie(other.level, other.lot, other.cell);
  }
};

/// Receivers on level ground, from its cells that have one.
void floodFlats(const Grid& level, Raster<uint32_t>& receiver) {
  std::priority_queue<Front, std::vector<Front>, std::greater<>> fronts;
  const auto enter = [&](uint32_t cell) {
    fronts.push({level[cell], static_cast<uint32_t>(latticeHash(0, cell, 0) >> 32), cell});
  };
  for (uint32_t cell = 0; cell < level.size(); ++cell) {
    if (receiver[cell] != kNoCell) continue;
    forNeighbours(level, cell, [&](uint32_t next, const Step&) {
      if (receiver[next] != kNoCell && level[next] == level[cell]) enter(next);
    });
  }
  while (!fronts.empty()) {
    const Front front = fronts.top();
    fronts.pop();
    forNeighbours(level, front.cell, [&](uint32_t next, const Step&) {
      if (receiver[next] != kNoCell || level[next] != front.level) return;
      receiver[next] = front.cell;
      enter(next);
    });
  }
}

/// A cell hands on what it has when the last of its donors has handed on.
Raster<uint32_t> areaOf(const Raster<uint32_t>& receiver) {
  Raster<uint8_t> donors(receiver.side());
  for (uint32_t cell = 0; cell < receiver.size(); ++cell)
    if (receiver[cell] != cell) ++donors[receiver[cell]];
  Raster<uint32_t> area(receiver.side(), 1);
  constexpr uint8_t kDone = 255;
  for (uint32_t start = 0; start < receiver.size(); ++start) {
    for (uint32_t cell = start; donors[cell] == 0;) {
      donors[cell] = kDone;
      const uint32_t to = receiver[cell];
      if (to == cell) break;
      area[to] += area[cell];
      --donors[to];
      cell = to;
    }
  }
  return area;
}

}  // namespace

Drainage drain(const Grid& height, const Raster<uint8_t>& outlet) {
  if (std::find(outlet.begin(), outlet.end(), uint8_t{1}) == outlet.end()) {
    Raster<uint8_t> lowest(height.side());
    lowest[lowestCell(height)] = 1;
    return drain(height, lowest);
  }
  Drainage drainage;
  drainage.level = waterLevel(height, outlet);
  drainage.receiver = steepestDescent(drainage.level, outlet);
  floodFlats(drainage.level, drainage.receiver);
  drainage.area = areaOf(drainage.receiver);
  return drainage;
}

}  // namespace tetrakis::tools::synth
