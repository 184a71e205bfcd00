// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/tiles/quantized_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "apps/tools/files/little_endian.hpp"
#include "apps/tools/tiles/placed_mesh.hpp"

namespace tetrakis::tools {
namespace {

constexpr uint32_t kLastStep = 32767;

double product(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// Around the middle of the box that holds the points.
struct Sphere {
  Vector centre{};
  double radius = 0;
};

Sphere sphereAround(const std::vector<Vector>& points) {
  Vector low = points[0], high = points[0];
  for (const Vector& point : points) {
    for (size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], point[k]);
      high[k] = std::max(high[k], point[k]);
    }
  }
  Sphere sphere;
  for (size_t k = 0; k < 3; ++k) sphere.centre[k] = (low[k] + high[k]) / 2;
  for (const Vector& p : points)
    sphere.radius = std::max(
        sphere.radius,
        std::hypot(p[0] - sphere.centre[0], p[1] - sphere.centre[1], p[2] - sphere.centre[2]));
  return sphere;
}

Vector scaledToSphere(const Vector& v) {
  return {v[0] / kSemiMajor, v[1] / kSemiMajor, v[2] / kSemiMinor};
}

/// The point that is hidden behind the horizon only where all of the tile is, in units of the
/// ellipsoid's axes: along the centre, as far out as any vertex asks for (Cesium, "Horizon
/// Culling"). Tiles so wide that no point will do get one that is always seen.
Vector horizonPoint(const std::vector<Vector>& points, const Vector& centre) {
  constexpr double kAlwaysSeen = 1e6;
  Vector direction = scaledToSphere(centre);
  const double length = std::sqrt(product(direction, direction));
  for (double& component : direction) component /= length;
  double farthest = 0;
  for (const Vector& point : points) {
    const Vector scaled = scaledToSphere(point);
    const double distance = std::sqrt(product(scaled, scaled));
    const double cos_a = std::min(product(scaled, direction) / distance, 1.0);
    const double sin_a = std::sqrt(1 - cos_a * cos_a), cos_b = 1 / std::max(distance, 1.0);
    const double reach = cos_a * cos_b - sin_a * std::sqrt(1 - cos_b * cos_b);
    farthest = std::max(farthest, reach > 1 / kAlwaysSeen ? 1 / reach : kAlwaysSeen);
  }
  if (!std::isfinite(farthest)) farthest = kAlwaysSeen;
  for (double& component : direction) component *= farthest;
  return direction;
}

uint32_t stepOf(double fraction) {
  return static_cast<uint32_t>(std::lround(std::clamp(fraction, 0.0, 1.0) * kLastStep));
}

/// Differences, signs in the last bit.
void putDeltas(LittleEndianBuffer& file, const std::vector<uint32_t>& values) {
  int32_t last = 0;
  for (const uint32_t value : values) {
    const int32_t delta = static_cast<int32_t>(value) - last;
    file.put(static_cast<uint16_t>((delta << 1) ^ (delta >> 31)));
    last = static_cast<int32_t>(value);
  }
}

void putVertices(LittleEndianBuffer& file, const TileMesh& mesh, const HeightRange& range) {
  std::array<std::vector<uint32_t>, 3> steps;
  const double heights = double{range.highest} - range.lowest;
  for (const TileMesh::Vertex& v : mesh.vertices) {
    steps[0].push_back(stepOf(double(v.column) / kTileCells));
    steps[1].push_back(stepOf(double(v.row) / kTileCells));
    steps[2].push_back(heights > 0 ? stepOf((double{v.height} - range.lowest) / heights) : 0);
  }
  file.put(static_cast<uint32_t>(mesh.vertices.size()));
  for (const std::vector<uint32_t>& axis : steps) putDeltas(file, axis);
}

/// High-water marks: 0 stands for the next new vertex, n for the one n before it. A tile has at
/// most 65^2 vertices, so all indices have 16 bits.
void putTriangles(LittleEndianBuffer& file, const std::vector<uint32_t>& triangles) {
  file.put(static_cast<uint32_t>(triangles.size() / 3));
  uint32_t next = 0;
  for (const uint32_t corner : triangles) {
    file.put(static_cast<uint16_t>(next - corner));
    if (corner == next) ++next;
  }
}

/// The vertices on one side, sorted along it.
void putEdge(LittleEndianBuffer& file, const TileMesh& mesh,
             const std::function<bool(const TileMesh::Vertex&)>& on_edge) {
  std::vector<uint16_t> edge;
  for (size_t i = 0; i < mesh.vertices.size(); ++i)
    if (on_edge(mesh.vertices[i])) edge.push_back(static_cast<uint16_t>(i));
  std::sort(edge.begin(), edge.end(), [&mesh](uint16_t a, uint16_t b) {
    const TileMesh::Vertex &one = mesh.vertices[a], &other = mesh.vertices[b];
    return one.column + one.row < other.column + other.row;
  });
  file.put(static_cast<uint32_t>(edge.size()));
  file.putAll(std::span<const uint16_t>(edge));
}

/// A normal on an octahedron that is unfolded into a square (Cigolle et al. 2014).
std::array<uint8_t, 2> octahedral(const Vector& normal) {
  const double sum = std::abs(normal[0]) + std::abs(normal[1]) + std::abs(normal[2]);
  double x = normal[0] / sum, y = normal[1] / sum;
  if (normal[2] < 0) {
    const double folded = (1 - std::abs(y)) * (x < 0 ? -1 : 1);
    y = (1 - std::abs(x)) * (y < 0 ? -1 : 1);
    x = folded;
  }
  const auto byte = [](double value) {
    return static_cast<uint8_t>(std::lround((value + 1) / 2 * 255));
  };
  return {byte(x), byte(y)};
}

void putExtension(LittleEndianBuffer& file, uint8_t id, std::span<const std::byte> content) {
  file.put(id);
  file.put(static_cast<uint32_t>(content.size()));
  file.putAll(content);
}

void putVector(LittleEndianBuffer& file, const Vector& vector) {
  for (const double component : vector) file.put(component);
}

void putHeader(LittleEndianBuffer& file, const Placed& placed, const HeightRange& range) {
  const Sphere sphere = sphereAround(placed.positions);
  putVector(file, sphere.centre);
  file.put(range.lowest);
  file.put(range.highest);
  putVector(file, sphere.centre);
  file.put(sphere.radius);
  putVector(file, horizonPoint(placed.positions, sphere.centre));
}

}  // namespace

std::vector<std::byte> encodeQuantizedMesh(const TileMesh& mesh, const GeographicTile& tile,
                                           const HeightRange& range, const std::string& metadata) {
  constexpr uint8_t kNormals = 1, kMetadata = 4;
  const Placed placed = place(mesh, tile);
  LittleEndianBuffer file;
  putHeader(file, placed, range);
  putVertices(file, mesh, range);
  putTriangles(file, mesh.triangles);
  putEdge(file, mesh, [](const TileMesh::Vertex& v) { return v.column == 0; });
  putEdge(file, mesh, [](const TileMesh::Vertex& v) { return v.row == 0; });
  putEdge(file, mesh, [](const TileMesh::Vertex& v) { return v.column == kTileCells; });
  putEdge(file, mesh, [](const TileMesh::Vertex& v) { return v.row == kTileCells; });
  std::vector<uint8_t> normals;
  for (const Vector& normal : placed.normals)
    for (const uint8_t byte : octahedral(normal)) normals.push_back(byte);
  putExtension(file, kNormals, std::as_bytes(std::span(normals)));
  if (metadata.empty()) return std::move(file.bytes);
  LittleEndianBuffer text;
  text.put(static_cast<uint32_t>(metadata.size()));
  text.putText(metadata);
  putExtension(file, kMetadata, text.bytes);
  return std::move(file.bytes);
}

}  // namespace tetrakis::tools
