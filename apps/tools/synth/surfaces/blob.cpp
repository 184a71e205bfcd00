// SPDX-License-Identifier: Apache-2.0
// The blob: an icosahedron whose faces are cut into equal parts, blown up to a sphere, with bumps.
#include <algorithm>
#include <map>

#include "apps/tools/synth/surfaces/shape.hpp"
#include "apps/tools/synth/surfaces/solid_noise.hpp"

namespace tetrakis::tools::synth {
namespace {

constexpr double kGolden = 1.618033988749895;

constexpr std::array<Spot, 12> kIcosahedron{{{-1, kGolden, 0},
                                             {1, kGolden, 0},
                                             {-1, -kGolden, 0},
                                             {1, -kGolden, 0},
                                             {0, -1, kGolden},
                                             {0, 1, kGolden},
                                             {0, -1, -kGolden},
                                             {0, 1, -kGolden},
                                             {kGolden, 0, -1},
                                             {kGolden, 0, 1},
                                             {-kGolden, 0, -1},
                                             {-kGolden, 0, 1}}};
constexpr std::array<Triangle, 20> kFaces{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

/// Points of faces cut into parts x parts triangles; those on edges and corners are shared.
class Sphere {
 public:
  explicit Sphere(uint32_t parts) : parts_(parts) {
    for (const Triangle& face : kFaces) addFace(face);
  }
  TriangleMesh shape{};

 private:
  /// Weights of a face's corners in parts; corners that weigh nothing do not count.
  uint32_t numberOf(const Triangle& face, const std::array<uint32_t, 3>& weights) {
    std::array<std::array<uint32_t, 2>, 3> key{};
    Spot sum{};
    for (size_t k = 0; k < 3; ++k)
      if (weights[k] > 0) key[k] = {face[k] + 1, weights[k]};
    std::sort(key.begin(), key.end());
    // In the order of the key: all faces round alike.
    for (const auto& [corner, weight] : key)
      if (weight > 0) sum = sum + double{1} * weight * kIcosahedron[corner - 1];
    const auto [found, is_new] =
        numbers_.try_emplace(key, static_cast<uint32_t>(shape.points.size()));
    if (is_new) shape.points.push_back(directionOf(sum));
    return found->second;
  }
  void addFace(const Triangle& face) {
    const auto at = [&](uint32_t i, uint32_t j) { return numberOf(face, {parts_ - i - j, i, j}); };
    for (uint32_t i = 0; i < parts_; ++i) {
      for (uint32_t j = 0; i + j < parts_; ++j) {
        shape.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        if (i + j + 1 < parts_)
          shape.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }

  uint32_t parts_;
  std::map<std::array<std::array<uint32_t, 2>, 3>, uint32_t> numbers_{};
};

}  // namespace

TriangleMesh blob(uint32_t triangles, uint64_t seed) {
  constexpr double kFaceCount = 20, kBumps = 0.7, kWidth = 1.3;
  constexpr int kOctaves = 2;
  const double parts = std::sqrt(triangles / kFaceCount);
  TriangleMesh shape = Sphere(std::max(1U, static_cast<uint32_t>(parts + 0.5))).shape;
  for (Spot& point : shape.points)
    point = (1 + kBumps * solidFractal(seed, kWidth * point, kOctaves)) * point;
  return shape;
}

}  // namespace tetrakis::tools::synth
