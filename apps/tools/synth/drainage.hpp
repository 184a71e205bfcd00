// SPDX-License-Identifier: Apache-2.0
// drain() computes where water flows on a raster of heights.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/tools/synth/grid.hpp"

namespace tetrakis::tools::synth {

struct Drainage {
  Raster<uint32_t> receiver;  ///< the neighbour that takes the water; outlets take their own
  Grid level;                 ///< height, or the water level of the depression
  Raster<uint32_t> area;      ///< cells that drain through, itself included
};

/// Cells with outlet 1 are where water leaves; without any, the lowest cell is one.
Drainage drain(const Grid& height, const Raster<uint8_t>& outlet);

/// Steps to the eight neighbours; kStepLength in cells.
struct Step {
  int32_t x, y;
  double length;
};
inline constexpr double kSqrt2 = 1.4142135623730951;
inline constexpr Step kSteps[8] = {{1, 0, 1},       {-1, 0, 1},      {0, 1, 1},
                                   {0, -1, 1},      {1, 1, kSqrt2},  {-1, 1, kSqrt2},
                                   {1, -1, kSqrt2}, {-1, -1, kSqrt2}};

/// Calls visit(cell) for every cell, each after its receiver.
template <class Visit>
void forUpstream(const Raster<uint32_t>& receiver, Visit visit) {
  Raster<uint8_t> visited(receiver.side());
  std::vector<uint32_t> path;
  for (uint32_t start = 0; start < receiver.size(); ++start) {
    for (uint32_t cell = start; !visited[cell]; cell = receiver[cell]) {
      visited[cell] = 1;
      path.push_back(cell);
    }
    for (; !path.empty(); path.pop_back()) visit(path.back());
  }
}

/// Calls visit(cell, step) for the neighbours inside the raster.
template <class T, class Visit>
void forNeighbours(const Raster<T>& raster, uint32_t cell, Visit visit) {
  const int64_t side = raster.side();
  const int64_t x = cell % side, y = cell / side;
  for (const Step& step : kSteps) {
    const int64_t nx = x + step.x, ny = y + step.y;
    if (nx < 0 || ny < 0 || nx >= side || ny >= side) continue;
    visit(static_cast<uint32_t>(ny * side + nx), step);
  }
}

}  // namespace tetrakis::tools::synth
