// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/pictures/ground_rays.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace tetrakis::inline pictures {

namespace {

constexpr float kLowest = -std::numeric_limits<float>::infinity();

/// A comparison with NaN is false: voids raise nothing.
float raised(float highest, float height) {
  return height > highest ? height : highest;
}

}  // namespace

MaximumMipmap::Level MaximumMipmap::cellsOf(const std::vector<float>& heights, Extent grid) {
  Level cells{grid.width - 1, grid.height - 1, {}};
  cells.highest.resize(size_t{cells.width} * cells.height);
  std::vector<float> higher(grid.width);  // of two vertices of a column
  float* out = cells.highest.data();
  for (uint32_t y = 0; y < cells.height; ++y, out += cells.width) {
    const float* const north = heights.data() + size_t{y} * grid.width;
    const float* const south = north + grid.width;
    for (uint32_t x = 0; x < grid.width; ++x)
      higher[x] = raised(raised(kLowest, north[x]), south[x]);
    for (uint32_t x = 0; x < cells.width; ++x) out[x] = raised(higher[x], higher[x + 1]);
  }
  return cells;
}

MaximumMipmap::Level MaximumMipmap::halved(const Level& fine) {
  Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
  coarse.highest.resize(size_t{coarse.width} * coarse.height);
  std::vector<float> higher(2 * size_t{coarse.width}, kLowest);
  float* out = coarse.highest.data();
  for (uint32_t y = 0; y < coarse.height; ++y, out += coarse.width) {
    const float* const north = fine.highest.data() + size_t{2 * y} * fine.width;
    const float* const south = 2 * y + 1 < fine.height ? north + fine.width : north;
    for (uint32_t x = 0; x < fine.width; ++x) higher[x] = raised(north[x], south[x]);
    for (uint32_t x = 0; x < coarse.width; ++x) out[x] = raised(higher[2 * x], higher[2 * x + 1]);
  }
  return coarse;
}

MaximumMipmap::MaximumMipmap(const std::vector<float>& heights, Extent grid) {
  assert(grid.samples() > 0 && heights.size() == grid.samples());
  levels_.push_back(cellsOf(heights, grid));
  while (levels_.back().width > 1 || levels_.back().height > 1)
    levels_.push_back(halved(levels_.back()));
}

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kSlack = 1e-9;  // parts that places are rounded by, at most
/// log2 of the blocks along the ground that rays begin with. Larger blocks nearly always have
/// something above the ray, and take time; smaller ones are more to pass over.
constexpr size_t kBlocksAlong = 5;

/// Triangles of a cell, as the parts of the unit square where side >= 0: the diagonal goes from
/// north-west to south-east where column + row is even, else from south-west to north-east.
struct HalfCell {
  double offset, along_c, along_r;  ///< side = offset + along_c c + along_r r

  bool holds(double c, double r) const { return offset + along_c * c + along_r * r >= -kSlack; }
};

struct Corners {
  double nw, ne, sw, se;
};

/// Plane over the cell at (0, 0), and the half that it counts in.
struct CellPlane {
  double at, slope_c, slope_r;
  HalfCell half;
};

std::array<CellPlane, 2> planesOf(const Corners& h, bool even) {
  if (even)
    return {{{h.nw, h.se - h.sw, h.sw - h.nw, {0, -1, 1}},
             {h.nw, h.ne - h.nw, h.se - h.ne, {0, 1, -1}}}};
  return {{{h.nw, h.ne - h.nw, h.sw - h.nw, {1, -1, -1}},
           {h.ne + h.sw - h.se, h.se - h.sw, h.se - h.ne, {-1, 1, 1}}}};
}

/// The least and the greatest height; of voids alone the least is above the greatest. Sixteen pairs
/// are found side by side, because each comparison waits for the one before. Comparisons with NaN
/// are false, so voids are neither.
std::pair<double, double> rangeOf(const std::vector<float>& heights) {
  std::array<float, 16> low, high;
  low.fill(std::numeric_limits<float>::infinity());
  high.fill(-std::numeric_limits<float>::infinity());
  const auto take = [&](size_t k, float h) {
    low[k] = h < low[k] ? h : low[k];
    high[k] = h > high[k] ? h : high[k];
  };
  size_t i = 0;
  for (; i + low.size() <= heights.size(); i += low.size())
    for (size_t k = 0; k < low.size(); ++k) take(k, heights[i + k]);
  for (; i < heights.size(); ++i) take(0, heights[i]);
  return {*std::min_element(low.begin(), low.end()), *std::max_element(high.begin(), high.end())};
}

struct Cell {
  int64_t column, row;
};

/// A square of 2^level cells a side, without the part that lies beyond the border.
struct Block {
  int64_t west, north, east, south;  ///< cells before east and south
};

Block blockAround(const Cell& cell, size_t level, const Extent& cells) {
  const int64_t column = cell.column >> level, row = cell.row >> level;
  return {column << level, row << level, std::min<int64_t>(cells.width, (column + 1) << level),
          std::min<int64_t>(cells.height, (row + 1) << level)};
}

/// The times at which a ray leaves the columns of a block, and its rows.
struct Exit {
  double columns, rows;
};

}  // namespace

/// A ray in columns, rows and metres of height.
struct GroundRays::Path {
  Vec3 origin, direction;  ///< column, height, row
  Vec3 inverse;            ///< of the direction

  Path(const Ray& ray, const GroundFrame& frame, double step = 1)
      : origin{(ray.origin[0] / frame.spacing_x + (frame.width - 1.0) / 2) / step, ray.origin[1],
               (ray.origin[2] / frame.spacing_y + (frame.height - 1.0) / 2) / step},
        direction{ray.direction[0] / frame.spacing_x / step, ray.direction[1],
                  ray.direction[2] / frame.spacing_y / step},
        inverse{1 / direction[0], 1 / direction[1], 1 / direction[2]} {}

  double at(size_t axis, double t) const { return origin[axis] + t * direction[axis]; }
  /// The time at which the ray comes to a column (axis 0), height or row; kNever if it does not.
  double reaches(size_t axis, double value) const {
    return direction[axis] == 0 ? kNever : (value - origin[axis]) * inverse[axis];
  }

  /// The column (axis 0) or row (axis 2) of cells in which the ray is, from `least` to `most`.
  int64_t cellAt(size_t axis, double t, int64_t least, int64_t most) const {
    const double place = at(axis, t);
    if (!(place > static_cast<double>(least))) return least;  // not a number: any cell will do
    return place < static_cast<double>(most) ? static_cast<int64_t>(place) : most;
  }
  Exit exitFrom(const Block& block) const {
    return {reaches(0, static_cast<double>(direction[0] > 0 ? block.east : block.west)),
            reaches(2, static_cast<double>(direction[2] > 0 ? block.south : block.north))};
  }
  /// The cell that the ray enters from a block; t: when.
  Cell behind(const Block& block, const Exit& exit, double t) const {
    if (exit.columns <= exit.rows)
      return {direction[0] > 0 ? block.east : block.west - 1,
              cellAt(2, t, block.north, block.south - 1)};
    return {cellAt(0, t, block.west, block.east - 1),
            direction[2] > 0 ? block.south : block.north - 1};
  }
};

GroundRays::GroundRays(Relief relief)
    : relief_(std::move(relief)), highest_(relief_.heights, relief_.extent()) {
  const GroundFrame& f = relief_.frame;
  const auto [low, high] = rangeOf(relief_.heights);
  const double x = (f.width - 1.0) * f.spacing_x / 2, z = (f.height - 1.0) * f.spacing_y / 2;
  bounds_ = low <= high ? Bounds{{-x, low, -z}, {x, high, z}} : Bounds{{-x, 0, -z}, {x, 0, z}};
}

std::optional<GroundHit> GroundRays::hitInCell(uint32_t column, uint32_t row, const Path& path,
                                               double enter, double leave) const {
  const uint32_t width = relief_.extent().width;
  const float* north = &relief_.heights[size_t{row} * width + column];
  const float* south = north + width;
  const Corners corners{north[0], north[1], south[0], south[1]};
  std::optional<GroundHit> first;
  double soonest = leave + kSlack * std::abs(leave);
  for (const CellPlane& p : planesOf(corners, (column + row) % 2 == 0)) {
    // The plane is met where the height of the ray above it falls to 0; NaN where a corner is void.
    const double c = path.origin[0] - column, r = path.origin[2] - row;
    const double above = path.origin[1] - (p.at + p.slope_c * c + p.slope_r * r);
    const double fall =
        path.direction[1] - p.slope_c * path.direction[0] - p.slope_r * path.direction[2];
    const double t = -above / fall;
    if (!(t >= enter - kSlack * std::abs(enter) && t <= soonest)) continue;
    const double hit_c = path.at(0, t), hit_r = path.at(2, t);
    if (!p.half.holds(hit_c - column, hit_r - row)) continue;
    soonest = t;
    first = GroundHit{hit_c,     hit_r,    t, p.at - p.slope_c * column - p.slope_r * row,
                      p.slope_c, p.slope_r};
  }
  return first;
}

std::optional<GroundHit> GroundRays::hit(const Ray& ray) const {
  if (highest_.cells().samples() == 0) return {};
  const double step = relief_.step;
  std::optional<GroundHit> found = firstHit(Path(ray, relief_.frame, step));
  if (!found) return found;
  found->column *= step;
  found->row *= step;
  found->slope_c /= step;
  found->slope_r /= step;
  return found;
}

std::optional<GroundRays::Stay> GroundRays::stayOf(const Path& path) const {
  // Flat ground may be the lowest there is: a ray that ended just there would miss it by rounding.
  constexpr double kMargin = 1;  // metre
  const std::array<double, 3> low = {0, bounds_.low[1] - kMargin, 0};
  const std::array<double, 3> high = {(relief_.frame.width - 1.0) / relief_.step,
                                      bounds_.high[1] + kMargin,
                                      (relief_.frame.height - 1.0) / relief_.step};
  Stay stay{0, kNever};
  for (const size_t axis : {0u, 1u, 2u}) {
    if (path.direction[axis] == 0) {
      if (path.origin[axis] < low[axis] || path.origin[axis] > high[axis]) return {};
      continue;
    }
    const auto [in, out] =
        std::minmax({path.reaches(axis, low[axis]), path.reaches(axis, high[axis])});
    stay = {std::max(stay.enter, in), std::min(stay.leave, out)};
  }
  if (!(stay.enter <= stay.leave)) return {};
  return stay;
}

/// Passes over blocks of which all cells lie below the ray; divides others.
std::optional<GroundHit> GroundRays::firstHit(const Path& path) const {
  const std::optional<Stay> stay = stayOf(path);
  if (!stay) return {};
  const Extent cells = highest_.cells();
  const size_t top = highest_.top();
  size_t level = top - std::min(top, kBlocksAlong);
  double now = stay->enter;
  Cell cell{path.cellAt(0, now, 0, int64_t{cells.width} - 1),
            path.cellAt(2, now, 0, int64_t{cells.height} - 1)};
  while (cell.column >= 0 && cell.column < cells.width && cell.row >= 0 &&
         cell.row < cells.height) {
    const Block block = blockAround(cell, level, cells);
    const Exit exit = path.exitFrom(block);
    const double leave = std::max(now, std::min({exit.columns, exit.rows, stay->leave}));
    const auto column = static_cast<uint32_t>(cell.column), row = static_cast<uint32_t>(cell.row);
    if (std::min(path.at(1, now), path.at(1, leave)) <= highest_.above(column, row, level)) {
      if (level > 0) {
        --level;
        continue;
      }
      if (const auto found = hitInCell(column, row, path, now, leave)) return found;
    }
    if (leave >= stay->leave) return {};
    now = leave;
    cell = path.behind(block, exit, now);
    level = std::min(level + 1, top);
  }
  return {};
}

std::optional<std::array<double, 2>> GroundRays::onPlane(const GroundHit& plane,
                                                         const Ray& ray) const {
  const Path path(ray, relief_.frame);
  const double above =
      path.origin[1] - (plane.at + plane.slope_c * path.origin[0] + plane.slope_r * path.origin[2]);
  const double fall =
      path.direction[1] - plane.slope_c * path.direction[0] - plane.slope_r * path.direction[2];
  const double t = -above / fall;
  if (!std::isfinite(t) || t <= 0) return {};
  return std::array<double, 2>{path.at(0, t), path.at(2, t)};
}

std::optional<double> GroundRays::heightAt(double x, double z) const {
  // A ray from far above; it meets the ground from there.
  const double top = bounds_.high[1] + 1;
  const std::optional<GroundHit> found = hit({{x, top, z}, {0, -1, 0}});
  if (!found) return {};
  return found->at + found->slope_c * found->column + found->slope_r * found->row;
}

}  // namespace tetrakis::inline pictures
