// SPDX-License-Identifier: Apache-2.0
// A CubeFit moves the samples of a cube so that what lies between them comes near the samples of a
// grid: by least squares, each sample of the grid counting for the area that it stands for on the
// Earth, and by conjugate gradients (A. Björck, "Numerical Methods for Least Squares Problems",
// 1996, algorithm 7.4.1: CGLS).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/forest.hpp"
#include "codec/cube/cube_interpolation.hpp"
#include "codec/cube/geographic_grid.hpp"

namespace tetrakis::inline cube {

class CubeFit {
 public:
  /// Refers to the cube.
  CubeFit(const GeographicGrid& grid, const Forest& cube, uint32_t threads);

  /// heights: of the grid; samples: the raster of the cube, nearly fitting already.
  void improve(std::span<const float> heights, std::span<float> samples) const;

 private:
  std::vector<float> onGrid(std::span<const float> samples) const;
  std::vector<float> onCube(const std::vector<float>& heights) const;
  double squares(const std::vector<float>& heights) const;

  const Forest* cube_;
  CubeInterpolation interpolation_;
  uint32_t columns_, stride_, rows_, threads_;
  std::vector<CubeCell> cells_;  ///< where the grid's samples lie, without a repeated column
  std::vector<float> areas_;     ///< of a sample in each row
};

}  // namespace tetrakis::inline cube
