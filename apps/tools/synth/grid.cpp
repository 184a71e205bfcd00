// SPDX-License-Identifier: Apache-2.0
// Work on rows by all processors; smoothing by running sums.
#include "apps/tools/synth/grid.hpp"

#include <thread>

#include "base/parallel.hpp"

namespace tetrakis::tools::synth {
namespace {

/// Blurs along the rows and transposes: twice does both directions.
Grid blurRowsTransposed(const Grid& grid, int64_t radius) {
  const uint32_t side = grid.side();
  Grid out(side);
  const double scale = 1 / static_cast<double>(2 * radius + 1);
  forRows(side, side, [&](uint32_t first, uint32_t end) {
    for (uint32_t y = first; y < end; ++y) {
      double sum = 0;
      for (int64_t x = -radius; x <= radius; ++x) sum += grid.clamped(x, y);
      for (uint32_t x = 0; x < side; ++x) {
        out.at(y, x) = sum * scale;
        sum += grid.clamped(int64_t{x} + radius + 1, y) - grid.clamped(int64_t{x} - radius, y);
      }
    }
  });
  return out;
}

}  // namespace

void forRows(uint32_t rows, uint32_t cells, const std::function<void(uint32_t, uint32_t)>& work) {
  constexpr uint32_t kCells = 1 << 16;  // fewer are not worth a thread
  const uint32_t strip = std::max(1u, kCells / std::max(1u, cells));
  const uint32_t strips = (rows + strip - 1) / strip;
  parallelFor(std::thread::hardware_concurrency(), strips, [&](size_t i) {
    const uint32_t first = static_cast<uint32_t>(i) * strip;
    work(first, std::min(first + strip, rows));
  });
}

Grid boxBlur(const Grid& grid, uint32_t radius) {
  return blurRowsTransposed(blurRowsTransposed(grid, radius), radius);
}

}  // namespace tetrakis::tools::synth
