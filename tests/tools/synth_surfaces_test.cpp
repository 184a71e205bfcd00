// SPDX-License-Identifier: Apache-2.0
// Sample surfaces: the same bytes everywhere, of the topology that is promised, under a texture
// without overlaps.
#include "apps/tools/synth/surfaces/synth_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace tetrakis::tools {
namespace {

constexpr std::array<SynthSurfaceKind, 3> kKinds{SynthSurfaceKind::kBlob, SynthSurfaceKind::kKnot,
                                                 SynthSurfaceKind::kScan};

/// FNV-1a, 64 bits.
uint64_t digest(const SynthSurface& surface) {
  uint64_t h = 0xcbf29ce484222325u;
  const auto add = [&h](std::span<const std::byte> bytes) {
    for (const std::byte b : bytes) h = (h ^ static_cast<uint64_t>(b)) * 0x100000001b3u;
  };
  add(std::as_bytes(std::span(surface.mesh.positions)));
  add(std::as_bytes(std::span(surface.mesh.texcoords)));
  add(std::as_bytes(std::span(surface.mesh.triangles)));
  add(surface.texture.data);
  return h;
}

/// With charts glued: numbers of distinct positions.
std::vector<uint32_t> welded(const MeshFile& mesh) {
  std::map<std::array<float, 3>, uint32_t> numbers;
  std::vector<uint32_t> corners;
  for (const uint32_t v : mesh.triangles) {
    const float* const p = &mesh.positions[3 * size_t{v}];
    corners.push_back(numbers.try_emplace({p[0], p[1], p[2]}, static_cast<uint32_t>(numbers.size()))
                          .first->second);
  }
  return corners;
}

struct Topology {
  long euler = 0;
  size_t loops = 0, components = 0;
  bool oriented = true;  ///< no directed edge twice, none of one point
  bool pinched = false;  ///< a point with more than one gap
};

/// Joins numbers to sets.
class Sets {
 public:
  explicit Sets(size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0U); }
  uint32_t rootOf(uint32_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void join(uint32_t a, uint32_t b) { parents_[rootOf(a)] = rootOf(b); }
  size_t countOf(const std::set<uint32_t>& members) {
    std::set<uint32_t> roots;
    for (const uint32_t i : members) roots.insert(rootOf(i));
    return roots.size();
  }

 private:
  std::vector<uint32_t> parents_;
};

Topology topologyOf(const std::vector<uint32_t>& corners) {
  Topology found;
  const uint32_t points = *std::max_element(corners.begin(), corners.end()) + 1;
  std::set<std::pair<uint32_t, uint32_t>> directed;
  Sets pieces(points), loops(points);
  for (size_t i = 0; i < corners.size(); ++i) {
    const uint32_t a = corners[i], b = corners[i % 3 == 2 ? i - 2 : i + 1];
    found.oriented = found.oriented && a != b && directed.insert({a, b}).second;
    pieces.join(a, b);
  }
  std::map<uint32_t, int> gaps;
  std::set<uint32_t> border, all;
  size_t edges = 0;
  for (const auto& [a, b] : directed) {
    const bool alone = !directed.contains({b, a});
    edges += alone || a < b;
    all.insert(a);
    if (!alone) continue;
    found.pinched = found.pinched || ++gaps[a] > 1;
    border.insert(a);
    loops.join(a, b);
  }
  found.euler =
      static_cast<long>(points) - static_cast<long>(edges) + static_cast<long>(corners.size() / 3);
  found.loops = loops.countOf(border);
  found.components = pieces.countOf(all);
  return found;
}

TEST(SynthSurfaces, AreTheSameBytesEverywhere) {
  const std::array<uint64_t, 3> expected{4996383627787038791U, 10765961153053054409U,
                                         13210191707616181U};
  for (size_t i = 0; i < kKinds.size(); ++i)
    EXPECT_EQ(digest(synthesizeSurface({kKinds[i], 2000, 7})), expected[i]) << kSynthSurfaces[i];
}

TEST(SynthSurfaces, HaveThePromisedTopology) {
  for (const SynthSurfaceKind kind : kKinds) {
    for (uint64_t seed = 0; seed < 4; ++seed) {
      SCOPED_TRACE(std::string(kSynthSurfaces[static_cast<size_t>(kind)]) + std::to_string(seed));
      const bool is_scan = kind == SynthSurfaceKind::kScan;
      const Topology found = topologyOf(welded(
          synthesizeSurface({kind, is_scan ? 8000U : 500U + 1000 * uint32_t(seed), seed}).mesh));
      EXPECT_TRUE(found.oriented);
      EXPECT_FALSE(found.pinched);
      EXPECT_EQ(found.components, 1U);
      const long genus = is_scan ? static_cast<long>(seed % 4) : kind == SynthSurfaceKind::kKnot;
      EXPECT_EQ(found.euler, 2 - 2 * genus - static_cast<long>(found.loops));
      EXPECT_EQ(found.loops >= 2, is_scan);
    }
  }
}

TEST(SynthSurfaces, HaveAboutSoManyTriangles) {
  for (const SynthSurfaceKind kind : kKinds) {
    for (const uint32_t triangles : {5000U, 30000U}) {
      if (kind == SynthSurfaceKind::kScan && triangles < 8000) continue;
      const SynthSurface surface = synthesizeSurface({kind, triangles, 3});
      EXPECT_NEAR(double(surface.mesh.triangles.size()) / 3, triangles, 0.15 * triangles)
          << kSynthSurfaces[static_cast<size_t>(kind)];
    }
  }
}

TEST(SynthSurfaces, SmallestOnesExist) {
  for (const SynthSurfaceKind kind : kKinds)
    EXPECT_GE(synthesizeSurface({kind, 20, 1}).mesh.triangles.size(), 60U);
}

/// Volume by the divergence theorem: positive if triangles are seen counter-clockwise from outside.
TEST(SynthSurfaces, FaceOutwards) {
  for (const SynthSurfaceKind kind : kKinds) {
    const MeshFile mesh = synthesizeSurface({kind, 3000, 2}).mesh;
    double volume = 0;
    for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
      const float* const a = &mesh.positions[3 * size_t{mesh.triangles[i]}];
      const float* const b = &mesh.positions[3 * size_t{mesh.triangles[i + 1]}];
      const float* const c = &mesh.positions[3 * size_t{mesh.triangles[i + 2]}];
      volume += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    EXPECT_GT(volume, 0.5) << kSynthSurfaces[static_cast<size_t>(kind)];
  }
}

/// Where triangles of the texture overlap, two places have one colour.
TEST(SynthSurfaces, ChartsDoNotOverlap) {
  for (const SynthSurfaceKind kind : kKinds) {
    const MeshFile mesh = synthesizeSurface({kind, 2000, 5}).mesh;
    double area = 0;
    for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
      const float* const a = &mesh.texcoords[2 * size_t{mesh.triangles[i]}];
      const float* const b = &mesh.texcoords[2 * size_t{mesh.triangles[i + 1]}];
      const float* const c = &mesh.texcoords[2 * size_t{mesh.triangles[i + 2]}];
      area += std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
    }
    EXPECT_GT(area, 0.2);
    EXPECT_LT(area, 0.9);
    for (const float at : mesh.texcoords) EXPECT_TRUE(at > 0 && at < 1);
  }
}

}  // namespace
}  // namespace tetrakis::tools
