// SPDX-License-Identifier: Apache-2.0
// The lattice is the one of codec/mesh over all tiles: the vertices that are multiples of
// kTileCells are always there. A centre lies in the middle of a diagonal, and needs the other two
// corners of its square; a midpoint lies in the middle of a side, and needs the centres beside it.
// Errors that are the largest of all that need a vertex make every choice conforming (Evans,
// Kirkpatrick and Townsend 2001).
#include "apps/tools/tiles/terrain_level.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "apps/tools/files/place/earth.hpp"

namespace tetrakis::tools {

TerrainLevel::TerrainLevel(const EarthGround& ground, const LevelSurface& surface,
                           double metres_per_unit, const TileRange& range)
    : range_(range),
      columns_((int64_t{range.x1} - range.x0 + 1) * kTileCells + 1),
      rows_((int64_t{range.y1} - range.y0 + 1) * kTileCells + 1),
      heights_(static_cast<size_t>(columns_ * rows_)) {
  const double cell = tileDegrees(range.level) / kTileCells;
  std::vector<double> longitudes;
  for (int64_t x = 0; x < columns_; ++x)
    longitudes.push_back(double(int64_t{range.x0} * kTileCells + x) * cell - 180);
  for (int64_t y = 0; y < rows_; ++y) {
    const std::span<float> row =
        std::span(heights_).subspan(at({0, y}), static_cast<size_t>(columns_));
    const double latitude = double(int64_t{range.y0} * kTileCells + y) * cell - 90;
    ground.sampleParallel(surface, latitude, longitudes, row);
    for (float& height : row) {
      ground_.push_back(!std::isnan(height));
      height = std::isnan(height) ? 0 : static_cast<float>(height * metres_per_unit);
      lowest_ = std::min(lowest_, height);
      highest_ = std::max(highest_, height);
    }
  }
}

/// How far the Earth rises over the chord between the ends, at the equator.
float TerrainLevel::sagitta(int64_t half, bool centre) const {
  constexpr double kRadius = 6378137;
  const double angle = 2 * double(half) * tileDegrees(range_.level) / kTileCells *
                       std::numbers::pi / 180 * (centre ? std::numbers::sqrt2 : 1);
  return static_cast<float>(kRadius * angle * angle / 8);
}

/// Of a square's corners in units of its side, one has two even coordinates, and the diagonal from
/// there ends where both are odd.
void TerrainLevel::lift(Place v, int64_t half, bool centre) {
  std::array<Place, 2> ends, needed;
  if (centre) {
    const int64_t side = 2 * half;
    const bool rising = ((v.x + phaseX() - half) / side + (v.y + phaseY() - half) / side) % 2 == 0;
    const int64_t turn = rising ? half : -half;
    ends = {Place{v.x - half, v.y - turn}, Place{v.x + half, v.y + turn}};
    needed = {Place{v.x - half, v.y + turn}, Place{v.x + half, v.y - turn}};
  } else {
    const bool level = (v.x / half) % 2 != 0;
    const int64_t x = level ? half : 0, y = level ? 0 : half;
    ends = {Place{v.x - x, v.y - y}, Place{v.x + x, v.y + y}};
    needed = {Place{v.x - y, v.y - x}, Place{v.x + y, v.y + x}};
  }
  const float middle = (heights_[at(ends[0])] + heights_[at(ends[1])]) / 2;
  float& error = errors_[at(v)];
  error = std::max(error, std::abs(heights_[at(v)] - middle) + sagitta(half, centre));
  if (outline_ &&
      (ground_[at(ends[0])] != ground_[at(v)] || ground_[at(ends[1])] != ground_[at(v)]))
    error = std::numeric_limits<float>::infinity();
  for (const Place& vertex : needed)
    if (inside(vertex)) errors_[at(vertex)] = std::max(errors_[at(vertex)], error);
}

/// What is needed at 180 degrees on one side is needed on the other: of the vertices that have not
/// told yet what they need, from midpoints of sides of 2 half on.
void TerrainLevel::joinEnds(int64_t half) {
  if (!goesRound()) return;
  for (int64_t y = 0; y < rows_; y += half) {
    float &west = errors_[at({0, y})], &east = errors_[at({columns_ - 1, y})];
    west = east = std::max(west, east);
  }
}

void TerrainLevel::chooseVertices(double error, bool outline) {
  outline_ = outline;
  kept_ = error;
  errors_.assign(heights_.size(), 0);
  for (int64_t half = 1; half < kTileCells; half *= 2) {
    joinEnds(half);
    for (int64_t y = 0; y < rows_; y += half)
      for (int64_t x = (y / half) % 2 == 0 ? half : 0; x < columns_; x += 2 * half)
        lift({x, y}, half, false);
    for (int64_t y = half; y < rows_; y += 2 * half)
      for (int64_t x = half; x < columns_; x += 2 * half) lift({x, y}, half, true);
  }
}

uint32_t TerrainLevel::number(TileMesh& mesh, std::vector<uint32_t>& numbers, const Place& origin,
                              const Place& v) const {
  const auto column = static_cast<uint32_t>(v.x - origin.x);
  const auto row = static_cast<uint32_t>(v.y - origin.y);
  uint32_t& known = numbers[size_t{row} * (kTileCells + 1) + column];
  if (known != 0) return known - 1;
  const auto height = [this, &v](int64_t x, int64_t y) {
    if (goesRound()) x += x < 0 ? columns_ - 1 : x >= columns_ ? 1 - columns_ : 0;
    const Place beside{std::clamp<int64_t>(x, 0, columns_ - 1),
                       std::clamp<int64_t>(y, 0, rows_ - 1)};
    return heights_[at(outline_ && !ground_[at(beside)] ? v : beside)];
  };
  const double cell = tileDegrees(range_.level) / kTileCells;
  const MetresPerDegree metres =
      metresPerDegree((double(range_.y0) * kTileCells + double(v.y)) * cell - 90);
  const auto slope = [cell](float rise, double per_degree) {
    return per_degree > 0 ? static_cast<float>(rise / (2 * cell * per_degree)) : 0;
  };
  mesh.vertices.push_back({column, row, heights_[at(v)],
                           slope(height(v.x + 1, v.y) - height(v.x - 1, v.y), metres.east),
                           slope(height(v.x, v.y + 1) - height(v.x, v.y - 1), metres.north),
                           ground_[at(v)]});
  known = static_cast<uint32_t>(mesh.vertices.size());
  return known - 1;
}

/// corners: the ends of the longest side, then the one opposite.
void TerrainLevel::split(TileMesh& mesh, std::vector<uint32_t>& numbers, const Place& origin,
                         const std::array<Place, 3>& corners) const {
  const auto& [a, b, c] = corners;
  const Place middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
  const bool finest = std::abs(a.x - b.x) == 1;
  if (!finest && errors_[at(middle)] > kept_) {
    split(mesh, numbers, origin, {c, a, middle});
    split(mesh, numbers, origin, {b, c, middle});
    return;
  }
  for (const Place& corner : corners)
    mesh.triangles.push_back(number(mesh, numbers, origin, corner));
}

TileMesh TerrainLevel::meshOf(const GeographicTile& tile) const {
  const int64_t x = (int64_t{tile.x} - range_.x0) * kTileCells, right = x + kTileCells;
  const int64_t y = (int64_t{tile.y} - range_.y0) * kTileCells, top = y + kTileCells;
  const bool rising = (tile.x + tile.y) % 2 == 0;
  TileMesh mesh;
  std::vector<uint32_t> numbers((kTileCells + 1) * (kTileCells + 1), 0);
  const Place origin{x, y}, a{x, y}, b{right, y}, c{right, top}, d{x, top};
  split(mesh, numbers, origin, rising ? std::array{c, a, b} : std::array{b, d, a});
  split(mesh, numbers, origin, rising ? std::array{a, c, d} : std::array{d, b, c});
  return mesh;
}

}  // namespace tetrakis::tools
