// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/globe_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "apps/tools/files/place/texture_place.hpp"

namespace tetrakis::tools {
namespace {

struct Direction {
  double longitude, latitude;  ///< in degrees
  bool at_pole;                ///< all longitudes are one place
};

/// The direction of the normal that a point lies on, by fixed points: a step leaves less than a
/// hundredth of the error.
Direction directionOf(std::span<const double> p, const tks_globe& body) {
  constexpr double kDegree = std::numbers::pi / 180, kAtPole = 1e-9;
  const double flat = body.semi_minor / body.semi_major, squared = 1 - flat * flat;
  const double across = std::hypot(p[0], p[1]);
  double latitude = std::atan2(p[2], across * (1 - squared));
  for (int step = 0; step < 6; ++step) {
    const double sine = std::sin(latitude);
    const double radius = body.semi_major / std::sqrt(1 - squared * sine * sine);
    latitude = std::atan2(p[2] + squared * radius * sine, across);
  }
  return {std::atan2(p[1], p[0]) / kDegree, latitude / kDegree, across < kAtPole * body.semi_major};
}

/// From longitudes and latitudes to places on the texture, 0 to 1 each.
class TextureUnder {
 public:
  TextureUnder(const tks_info& info, double degrees)
      : info_(info),
        degrees_(degrees),
        place_(PlacedRaster::heightsOf(info), PlacedRaster::textureOf(info)) {}

  std::array<float, 2> at(double longitude, double latitude) const {
    const double* const t = info_.geotransform;
    const double column = (longitude / degrees_ - t[0]) / t[1],
                 row = (latitude / degrees_ - t[3]) / t[5];
    if (!info_.texture_has_geotransform)
      return {static_cast<float>(column / info_.grid_width),
              static_cast<float>(std::clamp(row / info_.grid_height, 0., 1.))};
    const auto [x, y] = place_.texelAt(column - 0.5, row - 0.5);
    const double u = x / info_.texture_width, v = y / info_.texture_height;
    return {part(u, info_.texture_domain == TKS_DOMAIN_CYLINDER), part(v, false)};
  }

 private:
  static float part(double place, bool goes_on) {
    if (!std::isfinite(place)) return 0;
    return static_cast<float>(goes_on ? place : std::clamp(place, 0., 1.));
  }

  const tks_info& info_;
  double degrees_;
  TexturePlace place_;
};

/// Gives the corners of triangles longitudes that lie beside each other.
class Unwrapping {
 public:
  Unwrapping(const tks_info& info, const tks_globe& body, const GlobeMesh& mesh, MeshFile& file)
      : texture_(info, body.degrees), file_(file) {
    for (size_t i = 0; i < mesh.positions().size(); i += 3)
      directions_.push_back(directionOf(mesh.positions().subspan(i, 3), body));
    file_.texcoords.resize(2 * directions_.size());
    for (uint32_t v = 0; v < directions_.size(); ++v) put(v, directions_[v].longitude);
  }

  void run() {
    for (size_t t = 0; t < file_.triangles.size(); t += 3)
      unwrap(std::span<uint32_t, 3>(&file_.triangles[t], 3));
  }

 private:
  void unwrap(std::span<uint32_t, 3> corners) {
    const auto away = std::find_if(corners.begin(), corners.end(),
                                   [&](uint32_t v) { return !directions_[v].at_pole; });
    if (away == corners.end()) return;
    const double first = directions_[*away].longitude;
    double sum = 0, count = 0;
    for (uint32_t& v : corners) {
      const Direction& at = directions_[v];
      if (at.at_pole) continue;
      const double longitude = first + std::remainder(at.longitude - first, 360);
      sum += longitude;
      ++count;
      const auto turns = static_cast<int>(std::lround((longitude - at.longitude) / 360));
      if (turns == 0) continue;
      const auto [place, is_new] = turned_.try_emplace({v, turns}, 0u);
      if (is_new) place->second = copy(v, longitude);
      v = place->second;
    }
    for (uint32_t& v : corners)
      if (v < directions_.size() && directions_[v].at_pole) v = copy(v, sum / count);
  }

  uint32_t copy(uint32_t v, double longitude) {
    const auto added = static_cast<uint32_t>(file_.positions.size() / 3);
    for (std::vector<float>* values : {&file_.positions, &file_.normals})
      for (size_t k = 0; k < 3; ++k) values->push_back((*values)[3 * size_t{v} + k]);
    file_.texcoords.resize(file_.texcoords.size() + 2);
    put(added, longitude, directions_[v].latitude);
    return added;
  }
  void put(uint32_t v, double longitude) { put(v, longitude, directions_[v].latitude); }
  void put(uint32_t v, double longitude, double latitude) {
    const std::array<float, 2> place = texture_.at(longitude, latitude);
    std::copy(place.begin(), place.end(), file_.texcoords.begin() + std::ptrdiff_t{2} * v);
  }

  TextureUnder texture_;
  MeshFile& file_;
  std::vector<Direction> directions_;                    ///< of the vertices of the mesh
  std::map<std::pair<uint32_t, int>, uint32_t> turned_;  ///< copies, by vertex and turns
};

}  // namespace

void layOnCube(const tks_info& info, const tks_globe& body, const GlobeMesh& mesh, MeshFile& file) {
  Unwrapping(info, body, mesh, file).run();
}

}  // namespace tetrakis::tools
