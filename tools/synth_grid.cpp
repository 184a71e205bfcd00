// SPDX-License-Identifier: Apache-2.0
// Smoothing by running sums.
#include "tools/synth_grid.hpp"

namespace tetrakis::tools::synth {
namespace {

/// Blurs along the rows and transposes: twice does both directions.
Grid blurRowsTransposed(const Grid& grid, int64_t radius) {
  const uint32_t side = grid.side();
  Grid out(side);
  const double scale = 1 / static_cast<double>(2 * radius + 1);
  for (uint32_t y = 0; y < side; ++y) {
    double sum = 0;
    for (int64_t x = -radius; x <= radius; ++x) sum += grid.clamped(x, y);
    for (uint32_t x = 0; x < side; ++x) {
      out.at(y, x) = sum * scale;
      sum += grid.clamped(int64_t{x} + radius + 1, y) - grid.clamped(int64_t{x} - radius, y);
    }
  }
  return out;
}

}  // namespace

Grid boxBlur(const Grid& grid, uint32_t radius) {
  return blurRowsTransposed(blurRowsTransposed(grid, radius), radius);
}

}  // namespace tetrakis::tools::synth
