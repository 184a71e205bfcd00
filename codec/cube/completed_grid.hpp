// SPDX-License-Identifier: Apache-2.0
// A CompletedGrid says what lies between and around the samples of a geographic grid, all over the
// Earth. Behind a pole follow the same rows, half a turn away. Where a grid ends more than a row
// before the pole, its last row goes on, and turns into its mean along the way to the pole.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/cube/geographic_grid.hpp"

namespace tetrakis::inline cube {

class CompletedGrid {
 public:
  /// samples: as many as the grid has, which are copied.
  CompletedGrid(const GeographicGrid& grid, std::span<const float> samples);

  /// Bicubic. Any column; rows between the poles.
  float at(double column, double row) const;

 private:
  /// Where the grid ends: before its first row, or behind its last one.
  struct End {
    int64_t row;     ///< the outermost one
    int64_t beyond;  ///< -1 or 1: the way to the pole
    double pole;     ///< the row that the pole would have
    float mean;      ///< of the outermost row

    bool isAtPole() const;
    /// How much of the way to the pole a row has gone; 0 or less: it lies in the grid.
    double partOfWay(double row) const;
  };
  /// The four samples of a row around a column.
  struct Across;

  const float* start(int64_t row) const;
  float* start(int64_t row);
  End endAt(int64_t row, int64_t beyond, double pole) const;
  void goOn(const End& end);
  void goRound();

  uint32_t round_;
  int64_t height_;
  std::vector<float> padded_;
  End before_, behind_;
};

}  // namespace tetrakis::inline cube
