// SPDX-License-Identifier: Apache-2.0
// From samples and 4-8 meshes to scenes. The grid's diagonals are those of the tiling [4.8^2]
// (thesis, chapter 3): all four diagonals of a square of side 2 meet in its centre.
#include "tools/report/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/length_unit.hpp"
#include "base/samples.hpp"
#include "ground/preset_cameras.hpp"
#include "ground/vec3.hpp"

#include "tools/files/place/ground_spacing.hpp"

namespace tetrakis::tools {
namespace {

template <class T>
void appendSamples(std::span<const std::byte> data, std::vector<double>& values) {
  for (size_t i = 0; i + sizeof(T) <= data.size(); i += sizeof(T)) {
    T sample;
    std::memcpy(&sample, data.data() + i, sizeof(T));
    values.push_back(static_cast<double>(sample));
  }
}

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

struct Corner {
  int64_t x, y;
  double height;
};

/// Twice the signed area of (a, b, (x, y)).
int64_t doubleArea(const Corner& a, const Corner& b, int64_t x, int64_t y) {
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

void rasterizeTriangle(const Corner& a, const Corner& b, const Corner& c, Surface& surface) {
  const int64_t area = doubleArea(a, b, c.x, c.y);
  if (area == 0) return;
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
  const int64_t sign = area < 0 ? -1 : 1;
  for (int64_t y = top; y <= bottom; ++y)
    for (int64_t x = left; x <= right; ++x) {
      const int64_t wa = sign * doubleArea(b, c, x, y);
      const int64_t wb = sign * doubleArea(c, a, x, y);
      const int64_t wc = sign * doubleArea(a, b, x, y);
      if (wa < 0 || wb < 0 || wc < 0) continue;
      const double sum = static_cast<double>(wa) * a.height + static_cast<double>(wb) * b.height +
                         static_cast<double>(wc) * c.height;
      surface.values[static_cast<size_t>(y) * surface.width + static_cast<size_t>(x)] =
          sum / static_cast<double>(sign * area);
    }
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

Surface samplesOf(uint32_t width, uint32_t height, tks_sample sample,
                  std::span<const std::byte> data) {
  Surface surface{width, height, {}};
  surface.values.reserve(size_t{width} * height);
  withSampleType(sample, [&]<class T>(T) { appendSamples<T>(data, surface.values); });
  return surface;
}

Surface heightsOf(const HeightFile& file) {
  Surface surface = samplesOf(file.width, file.height, file.sample, file.data);
  for (double& value : surface.values) {
    const bool is_void = file.nodata && value == *file.nodata;
    value = is_void ? std::numeric_limits<double>::quiet_NaN() : value * file.scale + file.offset;
  }
  return surface;
}

Surface rasterize(const Mesh& mesh, uint32_t width, uint32_t height) {
  constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();
  Surface surface{width, height, std::vector<double>(size_t{width} * height, kVoid)};
  const auto corner = [&](uint32_t vertex) {
    const uint32_t index = mesh.gridIndices()[vertex];
    return Corner{index % width, index / width, mesh.heights()[vertex]};
  };
  const std::span<const uint32_t> triangles = mesh.triangles();
  for (size_t t = 0; t < triangles.size(); t += 3)
    rasterizeTriangle(corner(triangles[t]), corner(triangles[t + 1]), corner(triangles[t + 2]),
                      surface);
  return surface;
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

std::vector<tks_camera> toldCameras(const std::vector<Camera>& cameras, const GroundAxes& axes) {
  const auto tell = [&axes](const Vec3& from, double* to) {
    const auto [along, down] = axes.unplaced(from[0], from[2]);
    to[0] = along;
    to[1] = from[1];
    to[2] = down;
  };
  std::vector<tks_camera> told;
  for (const Camera& camera : cameras) {
    tks_camera& c = told.emplace_back();
    c.name = camera.name.c_str();
    tell(camera.eye, c.eye);
    tell(camera.target, c.target);
    tell(camera.up, c.up);
    c.fov_y = camera.fov_y;
    c.width = camera.width;
    c.height = camera.height;
    c.weight = camera.weight;
  }
  return told;
}

Result<std::vector<Camera>> chooseCameras(const CameraChoice& choice, const Bounds& bounds) {
  if (!choice.file.empty()) return readCameras(choice.file);
  return presetCameras(choice.view.empty() ? "oblique" : choice.view, bounds);
}

}  // namespace tetrakis::tools
