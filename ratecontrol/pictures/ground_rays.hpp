// SPDX-License-Identifier: Apache-2.0
// GroundRays takes a height field and rays of a camera and returns where the rays meet the ground.
// MaximumMipmap, the highest ground of blocks of cells, lets a ray skip all blocks below it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/plane.hpp"
#include "codec/ground/camera.hpp"

namespace tetrakis::inline pictures {

// MaximumMipmap holds the highest ground of square blocks of cells, level by level: each block of a
// level covers two by two blocks of the level before. A ray that passes above a block meets none of
// its cells (A. Tevs, I. Ihrke, H.-P. Seidel 2008: maximum mipmaps for fast, accurate, and scalable
// dynamic height field rendering).

class MaximumMipmap {
 public:
  /// heights: of a grid of at least one vertex, row by row; NaN is a void, which is below all. A
  /// cell lies between four vertices; a grid of one column or row has none.
  MaximumMipmap(const std::vector<float>& heights, Extent grid);

  /// How many cells there are.
  Extent cells() const { return {levels_[0].width, levels_[0].height}; }
  /// The level whose only block covers all cells; blocks of level k are 2^k cells a side.
  size_t top() const { return levels_.size() - 1; }
  /// The highest vertex of the block of that level around a cell.
  float above(uint32_t column, uint32_t row, size_t level) const {
    const Level& of = levels_[level];
    return of.highest[size_t{row >> level} * of.width + (column >> level)];
  }

 private:
  struct Level {
    uint32_t width = 0, height = 0;  ///< in blocks
    std::vector<float> highest;
  };
  static Level cellsOf(const std::vector<float>& heights, Extent grid);
  static Level halved(const Level& fine);

  std::vector<Level> levels_;  ///< from single cells up
};

// GroundRays finds where rays meet a height field: the two triangles of every cell, with the
// diagonals of the tetrakis tiling. Rays pass over blocks of cells that lie below them.

/// Heights in metres, row by row; NaN: void.
struct Relief {
  GroundFrame frame;
  std::vector<float> heights;
  /// Columns and rows of the frame from one height to the next. The last heights lie on the border
  /// or beyond it.
  uint32_t step = 1;

  /// How many heights there are.
  Extent extent() const { return {along(frame.width), along(frame.height)}; }

 private:
  uint32_t along(uint32_t size) const { return size < 2 ? size : (size - 2) / step + 2; }
};

/// A half-line in the axes of GroundFrame.
struct Ray {
  Vec3 origin{}, direction{};
};

/// A point of the ground and the plane of its triangle: height = at + slope_c c + slope_r r.
struct GroundHit {
  double column = 0, row = 0;
  double far = 0;  ///< in lengths of the ray's direction
  double at = 0, slope_c = 0, slope_r = 0;
};

class GroundRays {
 public:
  explicit GroundRays(Relief relief);

  /// The first triangle that the ray meets, from either side; none touches a void. One column or
  /// row of heights has no triangles.
  std::optional<GroundHit> hit(const Ray& ray) const;

  /// The place where the ray meets the plane of a hit, in columns and rows; nothing if it runs
  /// along the plane.
  std::optional<std::array<double, 2>> onPlane(const GroundHit& plane, const Ray& ray) const;

  /// Height of the ground between the samples; nothing beyond the border and at voids.
  std::optional<double> heightAt(double x, double z) const;

  const GroundFrame& frame() const { return relief_.frame; }
  const Bounds& bounds() const { return bounds_; }

 private:
  struct Path;  ///< a ray in columns and rows
  /// The time during which a ray is between the borders, and within the range of the heights.
  struct Stay {
    double enter, leave;
  };
  std::optional<Stay> stayOf(const Path& path) const;

  /// Hits are in the columns and rows of the relief's own heights, as hitInCell() gives them.
  std::optional<GroundHit> firstHit(const Path& path) const;
  std::optional<GroundHit> hitInCell(uint32_t column, uint32_t row, const Path& path, double enter,
                                     double leave) const;

  Relief relief_;
  MaximumMipmap highest_;
  Bounds bounds_;
};

}  // namespace tetrakis::inline pictures
