// SPDX-License-Identifier: Apache-2.0
#include "codec/mesh/forest/glued_triangles.hpp"

#include <algorithm>
#include <utility>

namespace tetrakis::inline forest {
namespace {

/// From one sample of a raster to another one.
using Way = std::pair<uint32_t, uint32_t>;

class Samples {
 public:
  explicit Samples(const Forest& forest) : forest_(forest), side_(forest.side()) {}

  uint32_t patch(uint32_t sample) const { return sample / side_ / side_; }
  uint32_t x(uint32_t sample) const { return sample % side_; }
  uint32_t y(uint32_t sample) const { return sample / side_ % side_; }
  uint32_t at(uint32_t patch, uint32_t x, uint32_t y) const {
    return (patch * side_ + y) * side_ + x;
  }
  /// The one that is coded for it.
  uint32_t owner(uint32_t sample) const {
    const Forest::Place owner =
        forest_.owner(side_ - 1, {patch(sample), int64_t{x(sample)}, int64_t{y(sample)}});
    return at(owner.patch, static_cast<uint32_t>(owner.x), static_cast<uint32_t>(owner.y));
  }

  /// The same way in the patch behind the side of a patch that it runs along, or in its own patch
  /// if it runs along none. False where it runs along a border.
  bool cross(Way& way) const {
    const uint32_t last = side_ - 1;
    const auto [a, b] = way;
    const uint32_t first = patch(a) * Forest::kSides;
    if (y(a) == 0 && y(b) == 0) return cross(first, {x(a), x(b)}, way);
    if (x(a) == last && x(b) == last) return cross(first + 1, {y(a), y(b)}, way);
    if (y(a) == last && y(b) == last) return cross(first + 2, {x(a), x(b)}, way);
    if (x(a) == 0 && x(b) == 0) return cross(first + 3, {y(a), y(b)}, way);
    return true;
  }

 private:
  static bool runsClockwise(uint32_t side) { return side % Forest::kSides < 2; }

  /// along: from where to where on the side.
  bool cross(uint32_t side, Way along, Way& way) const {
    const uint32_t other = forest_.sides()[side];
    if (other == Forest::kBorder) return false;
    const bool turned = runsClockwise(side) == runsClockwise(other);
    const auto sampleAt = [&](uint32_t k) {
      const uint32_t last = side_ - 1, patch = other / Forest::kSides;
      if (turned) k = last - k;
      switch (other % Forest::kSides) {
        case 0:
          return at(patch, k, 0);
        case 1:
          return at(patch, last, k);
        case 2:
          return at(patch, k, last);
        default:
          return at(patch, 0, k);
      }
    };
    way = {sampleAt(along.first), sampleAt(along.second)};
    return true;
  }

  const Forest& forest_;
  uint32_t side_;
};

uint32_t after(uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// Marks the middles of edges that are not the only ones between their ends, or that join a vertex
/// with itself. False if there are none that can be split.
bool markDoubleEdges(const Samples& samples, const GluedTriangles& mesh,
                     std::vector<uint8_t>& marks) {
  std::vector<std::pair<Way, uint32_t>> edges;
  for (uint32_t side = 0; side < mesh.sides.size(); ++side) {
    if (mesh.sides[side] != GluedTriangles::kBorder && mesh.sides[side] < side) continue;
    const uint32_t a = samples.owner(mesh.samples[side]);
    const uint32_t b = samples.owner(mesh.samples[after(side)]);
    edges.push_back({{std::min(a, b), std::max(a, b)}, side});
  }
  std::sort(edges.begin(), edges.end());
  bool marked = false;
  for (size_t i = 0; i < edges.size(); ++i) {
    const Way& ends = edges[i].first;
    const bool is_double = (i > 0 && edges[i - 1].first == ends) ||
                           (i + 1 < edges.size() && edges[i + 1].first == ends);
    if (!is_double && ends.first != ends.second) continue;
    const uint32_t side = edges[i].second;
    const uint32_t a = mesh.samples[side], b = mesh.samples[after(side)];
    const uint32_t x = samples.x(a) + samples.x(b), y = samples.y(a) + samples.y(b);
    if (x % 2 != 0 || y % 2 != 0) continue;
    marks[samples.owner(samples.at(samples.patch(a), x / 2, y / 2))] = 1;
    marked = true;
  }
  return marked;
}

}  // namespace

GluedTriangles gluedTriangles(const ForestLattice& lattice, std::span<const ForestVertex> vertices,
                              std::span<const uint8_t> known) {
  const LatticeMesh mesh = patchesOf(lattice, vertices);
  GluedTriangles out;
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const auto sample = [&](size_t k) { return mesh.vertices[mesh.triangles[i + k]]; };
    if (!known.empty() && (known[sample(0)] == 0 || known[sample(1)] == 0 || known[sample(2)] == 0))
      continue;
    for (size_t k = 0; k < 3; ++k) out.samples.push_back(sample(k));
  }
  const Samples samples(lattice.forest());
  const auto wayOf = [&](uint32_t side) {
    return Way{out.samples[side], out.samples[after(side)]};
  };
  std::vector<std::pair<Way, uint32_t>> sides;
  for (uint32_t side = 0; side < out.samples.size(); ++side) sides.push_back({wayOf(side), side});
  std::sort(sides.begin(), sides.end());
  for (uint32_t side = 0; side < out.samples.size(); ++side) {
    uint32_t& glued = out.sides.emplace_back(GluedTriangles::kBorder);
    Way way = wayOf(side);
    if (!samples.cross(way)) continue;
    const Way back{way.second, way.first};
    const auto found = std::lower_bound(sides.begin(), sides.end(), std::pair(back, 0u));
    if (found != sides.end() && found->first == back) glued = found->second;
  }
  return out;
}

std::vector<ForestVertex> singleEdges(const ForestLattice& lattice) {
  const Samples samples(lattice.forest());
  std::vector<uint8_t> marks(lattice.forest().raster().samples());
  std::vector<ForestVertex> vertices;
  while (markDoubleEdges(samples, gluedTriangles(lattice, vertices), marks))
    vertices = closureOfMarks(lattice, marks);
  return vertices;
}

}  // namespace tetrakis::inline forest
