// SPDX-License-Identifier: Apache-2.0
// Priority flood (Barnes, Lehman, Mulla, "Priority-flood", Computers & Geosciences 62, 2014): water
// rises from the outlets, so each cell is reached over its lowest pass. Steepest descent then
// chooses among the neighbours that were reached before.
#include "tools/synth_drainage.hpp"

#include <functional>
#include <queue>
#include <tuple>

namespace tetrakis::tools::synth {
namespace {

/// A cell that water has reached. The order is total, so ties fall the same way everywhere; on
/// flats a hash decides, which lets rivers wander there instead of following the raster.
struct Front {
  double level;
  uint32_t lot, cell;

  bool operator>(const Front& other) const {
    return std::tie(level, lot, cell) > std::tie(other.level, other.lot, other.cell);
  }
};

class Flood {
 public:
  Flood(const Grid& height, Drainage& drainage)
      : height_(height), drainage_(drainage), reached_(height.side(), 0) {}

  void enter(uint32_t cell, double level, uint32_t from) {
    reached_[cell] = 1;
    drainage_.level[cell] = level;
    drainage_.receiver[cell] = from;
    front_.push({level, static_cast<uint32_t>(latticeHash(0, cell, 0) >> 32), cell});
  }

  void run() {
    while (!front_.empty()) {
      const Front front = front_.top();
      front_.pop();
      drainage_.order.push_back(front.cell);
      forNeighbours(height_, front.cell, [&](uint32_t next, const Step&) {
        if (!reached_[next]) enter(next, std::max(front.level, height_[next]), front.cell);
      });
    }
  }

 private:
  const Grid& height_;
  Drainage& drainage_;
  Raster<uint8_t> reached_;
  std::priority_queue<Front, std::vector<Front>, std::greater<>> front_;
};

uint32_t lowestCell(const Grid& height) {
  uint32_t lowest = 0;
  for (uint32_t cell = 1; cell < height.size(); ++cell)
    if (height[cell] < height[lowest]) lowest = cell;
  return lowest;
}

/// On flats, where no neighbour is lower, the flood's own path stays.
void followSteepestDescent(Drainage& drainage) {
  for (const uint32_t cell : drainage.order) {
    if (drainage.receiver[cell] == cell) continue;
    double steepest = 0;
    forNeighbours(drainage.level, cell, [&](uint32_t next, const Step& step) {
      const double slope = (drainage.level[cell] - drainage.level[next]) / step.length;
      if (slope > steepest) {
        steepest = slope;
        drainage.receiver[cell] = next;
      }
    });
  }
}

}  // namespace

Drainage drain(const Grid& height, const Raster<uint8_t>& outlet) {
  Drainage drainage{{}, Raster<uint32_t>(height.side()), Grid(height.side()), {}};
  drainage.order.reserve(height.size());
  Flood flood(height, drainage);
  bool drained = false;
  for (uint32_t cell = 0; cell < height.size(); ++cell) {
    if (!outlet[cell]) continue;
    flood.enter(cell, height[cell], cell);
    drained = true;
  }
  if (!drained) {
    const uint32_t cell = lowestCell(height);
    flood.enter(cell, height[cell], cell);
  }
  flood.run();
  followSteepestDescent(drainage);
  drainage.area = Grid(height.side(), 1);
  for (auto cell = drainage.order.rbegin(); cell != drainage.order.rend(); ++cell)
    if (const uint32_t to = drainage.receiver[*cell]; to != *cell)
      drainage.area[to] += drainage.area[*cell];
  return drainage;
}

}  // namespace tetrakis::tools::synth
