// SPDX-License-Identifier: Apache-2.0
// From surfaces and 4-8 meshes to scenes. The grid's diagonals are those of the tiling [4.8^2]
// (thesis, chapter 3): all four diagonals of a square of side 2 meet in its centre.
#include "apps/tools/report/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "apps/tools/files/place/ground_spacing.hpp"
#include "base/coordinates.hpp"

namespace tetrakis::tools {
namespace {

void appendVertex(const PlacedFrame& frame, uint32_t grid_index, double height, MeshFile& mesh) {
  const double column = grid_index % frame.width, row = grid_index / frame.width;
  const double last_column = frame.width - 1.0, last_row = frame.height - 1.0;
  const auto [east, south] = frame.axes.placed((column - last_column / 2) * frame.spacing_x,
                                               (row - last_row / 2) * frame.spacing_y);
  mesh.positions.push_back(static_cast<float>(east));
  mesh.positions.push_back(static_cast<float>(height * frame.metres_per_unit));
  mesh.positions.push_back(static_cast<float>(south));
  mesh.texcoords.push_back(static_cast<float>(column / last_column));
  mesh.texcoords.push_back(static_cast<float>(row / last_row));
}

/// Triangles of a mirrored raster run clockwise on the ground.
void turnTriangles(const GroundAxes& axes, MeshFile& mesh) {
  if (!axes.mirrored()) return;
  for (size_t i = 0; i < mesh.triangles.size(); i += 3)
    std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);
}

/// Unless a corner is void.
void appendTriangle(const Surface& heights, const std::array<uint32_t, 3>& corners,
                    MeshFile& mesh) {
  for (const uint32_t corner : corners)
    if (std::isnan(heights.values[corner])) return;
  mesh.triangles.insert(mesh.triangles.end(), corners.begin(), corners.end());
}

}  // namespace

PlacedFrame frameOf(const HeightFile& heights) {
  PlacedFrame frame = knownFrame({heights.width, heights.height, heights.spacing_x,
                                  heights.spacing_y, metresPerUnit(heights.unit).value_or(1)});
  if (heights.geotransform)
    frame.axes = groundAxes(*heights.geotransform, heights.width, heights.height, heights.crs);
  return frame;
}

PlacedFrame frameOf(const tks_info& info) {
  const auto [spacing_x, spacing_y] = spacingOf(info);
  PlacedFrame frame = knownFrame(
      {info.width, info.height, spacing_x, spacing_y, metresPerUnit(info.unit).value_or(1)});
  if (info.has_geotransform)
    frame.axes = groundAxes(std::to_array(info.geotransform), info.width, info.height, info.crs);
  return frame;
}

PlacedFrame frameOf(const ImageFile& image) {
  return GroundFrame{2, 2, static_cast<double>(image.width), static_cast<double>(image.height), 1};
}

MeshFile fullGrid(const Surface& heights, const PlacedFrame& frame) {
  MeshFile mesh;
  const uint32_t w = heights.width, h = heights.height;
  mesh.positions.reserve(heights.values.size() * 3);
  mesh.texcoords.reserve(heights.values.size() * 2);
  for (uint32_t i = 0; i < w * h; ++i) {
    const double height = heights.values[i];
    appendVertex(frame, i, std::isnan(height) ? 0 : height, mesh);  // no triangle uses a void one
  }
  mesh.triangles.reserve(size_t{6} * (w - 1) * (h - 1));
  for (uint32_t row = 0; row + 1 < h; ++row)
    for (uint32_t column = 0; column + 1 < w; ++column) {
      // nw--ne   The diagonal ends where column + row is even: nw-se or sw-ne.
      // sw--se
      const uint32_t nw = row * w + column, ne = nw + 1, sw = nw + w, se = sw + 1;
      if ((row + column) % 2 == 0) {
        appendTriangle(heights, {nw, sw, se}, mesh);
        appendTriangle(heights, {nw, se, ne}, mesh);
      } else {
        appendTriangle(heights, {nw, sw, ne}, mesh);
        appendTriangle(heights, {ne, sw, se}, mesh);
      }
    }
  turnTriangles(frame.axes, mesh);
  return mesh;
}

MeshFile placeMesh(const Mesh& mesh, const PlacedFrame& frame) {
  MeshFile placed;
  placed.positions.reserve(size_t{3} * mesh.vertexCount());
  placed.texcoords.reserve(size_t{2} * mesh.vertexCount());
  for (uint32_t v = 0; v < mesh.vertexCount(); ++v)
    appendVertex(frame, mesh.gridIndices()[v], mesh.heights()[v], placed);
  placed.triangles.assign(mesh.triangles().begin(), mesh.triangles().end());
  turnTriangles(frame.axes, placed);
  return placed;
}

Bounds boundsOf(const Surface& heights, const PlacedFrame& frame) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double height : heights.values) {
    if (std::isnan(height)) continue;
    low = std::min(low, height);
    high = std::max(high, height);
  }
  if (low > high) low = high = 0;
  const double along = (frame.width - 1.0) * frame.spacing_x / 2;
  const double down = (frame.height - 1.0) * frame.spacing_y / 2;
  const auto reach = [&](size_t k) {
    return std::abs(frame.axes.along[k]) * along + std::abs(frame.axes.down[k]) * down;
  };
  const double x = reach(0), z = reach(1);
  return {{-x, low * frame.metres_per_unit, -z}, {x, high * frame.metres_per_unit, z}};
}

}  // namespace tetrakis::tools
