// SPDX-License-Identifier: Apache-2.0
// Raster is a square raster of numbers, which the steps of the sample terrain pass on.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "apps/tools/synth/noise.hpp"

namespace tetrakis::tools::synth {

template <class T>
class Raster {
 public:
  Raster() = default;
  explicit Raster(uint32_t side, T value = T()) : side_(side), cells_(size_t{side} * side, value) {}

  uint32_t side() const { return side_; }
  size_t size() const { return cells_.size(); }
  auto begin() const { return cells_.begin(); }
  auto end() const { return cells_.end(); }
  T& operator[](size_t cell) { return cells_[cell]; }
  const T& operator[](size_t cell) const { return cells_[cell]; }
  T& at(uint32_t x, uint32_t y) { return cells_[size_t{y} * side_ + x]; }
  const T& at(uint32_t x, uint32_t y) const { return cells_[size_t{y} * side_ + x]; }

  /// Nearest cell for coordinates beyond the border.
  const T& clamped(int64_t x, int64_t y) const {
    const int64_t last = int64_t{side_} - 1;
    return at(static_cast<uint32_t>(std::clamp<int64_t>(x, 0, last)),
              static_cast<uint32_t>(std::clamp<int64_t>(y, 0, last)));
  }

 private:
  uint32_t side_ = 0;
  std::vector<T> cells_;
};

using Grid = Raster<double>;

/// Bilinear, the border continued.
inline double sampleAt(const Grid& grid, Point p) {
  const int64_t x = floorOf(p.x), y = floorOf(p.y);
  const double u = p.x - static_cast<double>(x), v = p.y - static_cast<double>(y);
  return mix(mix(grid.clamped(x, y), grid.clamped(x + 1, y), u),
             mix(grid.clamped(x, y + 1), grid.clamped(x + 1, y + 1), u), v);
}

/// Calls work(first, end) for rows that make up [0, rows), of `cells` cells each, on all
/// processors. What it writes must not depend on how the rows are divided.
void forRows(uint32_t rows, uint32_t cells, const std::function<void(uint32_t, uint32_t)>& work);

/// function(x, y) for every cell.
template <class T, class Function>
Raster<T> rasterOf(uint32_t side, Function function) {
  Raster<T> raster(side);
  forRows(side, side, [&](uint32_t first, uint32_t end) {
    for (uint32_t y = first; y < end; ++y)
      for (uint32_t x = 0; x < side; ++x) raster.at(x, y) = function(x, y);
  });
  return raster;
}

/// Mean over (2 radius + 1) x (2 radius + 1) cells, the border continued.
Grid boxBlur(const Grid& grid, uint32_t radius);

}  // namespace tetrakis::tools::synth
