// SPDX-License-Identifier: Apache-2.0
#include "codec/remesh/mesh_distance.hpp"

#include <algorithm>
#include <limits>

#include "base/portable_math.hpp"

namespace tetrakis::inline remesh {
namespace {

// The plastic number to the powers -1 and -2: multiples of them, modulo 1, fill the square evenly
// (Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
constexpr double kPlastic1 = 0.7548776662466927;
constexpr double kPlastic2 = 0.5698402909980532;

/// For each triangle the doubled area of all triangles up to it, or if no triangle has an area,
/// their number.
std::vector<double> cumulatedAreas(const TriangleMesh& mesh) {
  std::vector<double> areas;
  areas.reserve(mesh.triangles.size());
  double sum = 0;
  for (const Triangle& triangle : mesh.triangles) {
    sum += length(areaNormal(mesh, triangle));
    areas.push_back(sum);
  }
  if (sum > 0) return areas;
  for (size_t t = 0; t < areas.size(); ++t) areas[t] = static_cast<double>(t + 1);
  return areas;
}

/// Where place number `i` lies in its triangle.
std::array<double, 3> evenWeights(size_t i) {
  const double u = static_cast<double>(i) * kPlastic1, v = static_cast<double>(i) * kPlastic2;
  double right = u - std::floor(u), up = v - std::floor(v);
  if (right + up > 1) {  // it lies in the other half of the square
    right = 1 - right;
    up = 1 - up;
  }
  return {1 - right - up, right, up};
}

/// From `count` places of `from` to the mesh of `to`; infinite if that has no triangles.
OneWayDistance distanceTo(const TriangleTree& to, const TriangleMesh& from, size_t count) {
  const std::vector<SurfacePoint> places = evenPlaces(from, count);
  OneWayDistance result;
  if (places.empty()) return result;
  double squares = 0;
  for (const SurfacePoint& place : places) {
    const auto nearest = to.closest(at(from, place));
    const double distance = nearest ? nearest->distance : std::numeric_limits<double>::infinity();
    squares += distance * distance;
    result.largest = std::max(result.largest, distance);
  }
  result.rms = std::sqrt(squares / static_cast<double>(places.size()));
  return result;
}

}  // namespace

std::vector<SurfacePoint> evenPlaces(const TriangleMesh& mesh, size_t count) {
  std::vector<SurfacePoint> places;
  if (mesh.triangles.empty()) return places;
  const std::vector<double> areas = cumulatedAreas(mesh);
  places.reserve(count);
  size_t triangle = 0;
  for (size_t i = 0; i < count; ++i) {
    const double part = (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    while (triangle + 1 < areas.size() && areas[triangle] <= part * areas.back()) ++triangle;
    places.push_back({static_cast<uint32_t>(triangle), evenWeights(i)});
  }
  return places;
}

MeshDistance meshDistance(const TriangleTree& first, const TriangleTree& second, size_t count) {
  MeshDistance result;
  result.to_second = distanceTo(second, first.mesh(), count);
  result.to_first = distanceTo(first, second.mesh(), count);
  result.error = std::max(result.to_second.rms, result.to_first.rms);
  result.psnr = result.error > 0 ? 20 * portable::log10(diagonal(first.mesh()) / result.error)
                                 : std::numeric_limits<double>::infinity();
  return result;
}

}  // namespace tetrakis::inline remesh
