// SPDX-License-Identifier: Apache-2.0
// Adaptive meshes in the quadtree: the same triangles as the mesh that was stored, on grids of any
// size, and of a view all that it sees.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include "codec/mesh/quadtree/mesh_tree.hpp"
#include "tests/support/closed_sets.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/mesh_values.hpp"

namespace tetrakis {
namespace {

using Size = std::pair<uint32_t, uint32_t>;
using Triangle = std::array<uint32_t, 3>;  ///< samples, the smallest first

Lattice latticeOf(Size size) {
  return std::move(*Lattice::make(size.first, size.second));
}

std::vector<VertexId> randomClosedSet(const Lattice& lattice, double chance, uint32_t seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution choose(chance);
  std::vector<VertexId> chosen;
  for (VertexId v = 0; v < lattice.vertexCount(); ++v)
    if (choose(random)) chosen.push_back(v);
  return closureOf(lattice, chosen);
}

/// Any height that tells samples apart.
float heightAt(uint32_t sample) {
  return static_cast<float>(3 * sample + 1);
}

MeshTree treeOf(const Lattice& lattice, std::span<const VertexId> vertices) {
  std::vector<float> heights;
  for (const uint32_t sample : meshOf(lattice, vertices).vertices)
    heights.push_back(heightAt(sample));
  return {lattice, vertices, heights};
}

std::set<Triangle> trianglesOf(const LatticeMesh& mesh) {
  std::set<Triangle> triangles;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    Triangle corners;
    for (size_t k = 0; k < 3; ++k) corners[k] = mesh.vertices[mesh.triangles[t + k]];
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.insert(corners);
  }
  return triangles;
}

std::vector<uint32_t> sorted(std::vector<uint32_t> values) {
  std::sort(values.begin(), values.end());
  return values;
}

void expectHeights(const ViewMesh& view) {
  ASSERT_EQ(view.heights.size(), view.mesh.vertices.size());
  for (size_t i = 0; i < view.heights.size(); ++i)
    ASSERT_EQ(view.heights[i], heightAt(view.mesh.vertices[i]));
}

class EverySize : public testing::TestWithParam<Size> {
 protected:
  const Lattice lattice_ = latticeOf(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Sizes, EverySize,
                         testing::Values(Size{2, 2}, Size{2, 9}, Size{9, 2}, Size{3, 3},
                                         Size{3, 1000}, Size{5, 5}, Size{6, 6}, Size{4, 7},
                                         Size{8, 8}, Size{13, 11}, Size{17, 31}, Size{33, 65},
                                         Size{65, 66}, Size{22, 150}, Size{200, 300}));

TEST_P(EverySize, EveryVertexHasAPlaceOfItsOwn) {
  std::set<QuadtreePlace> places;
  for (VertexId v = 0; v < lattice_.vertexCount(); ++v)
    ASSERT_TRUE(places.insert(placeOf(lattice_, lattice_.site(v))).second);
}

TEST_P(EverySize, HoldsTheMeshThatWasStored) {
  uint32_t seed = 1;
  for (const double chance : {0.0, 0.001, 0.02, 0.1, 0.5, 1.0}) {
    const std::vector<VertexId> set = randomClosedSet(lattice_, chance, seed++);
    const LatticeMesh expected = meshOf(lattice_, set);
    const ViewMesh all = treeOf(lattice_, set).whole();
    ASSERT_EQ(all.mesh.triangles.size(), expected.triangles.size());
    ASSERT_EQ(trianglesOf(all.mesh), trianglesOf(expected));
    ASSERT_EQ(sorted(all.mesh.vertices), sorted(expected.vertices));
    checks::expectConforming(all.mesh, lattice_.width(), lattice_.height());
    expectHeights(all);
  }
}

TEST_P(EverySize, ParentsComeBeforeTheirChildren) {
  const std::vector<VertexId> set = randomClosedSet(lattice_, 0.05, 9);
  const MeshTree tree = treeOf(lattice_, set);
  for (const VertexId v : set) {
    const Site site = lattice_.site(v);
    const uint32_t number = tree.quadtree().find(placeOf(lattice_, site));
    ASSERT_NE(number, kNoVertex);
    lattice_.forEachParent(site, [&](Site parent) {
      ASSERT_LT(tree.quadtree().find(placeOf(lattice_, parent)), number);
    });
  }
}

TEST(MeshTree, HoldsEveryClosureOfOneVertexOnAllSmallGrids) {
  for (uint32_t width = 2; width <= 14; ++width)
    for (uint32_t height = 2; height <= 14; ++height) {
      const Lattice lattice = latticeOf({width, height});
      for (VertexId v = 0; v < lattice.vertexCount(); ++v) {
        const std::vector<VertexId> set = closureOf(lattice, std::span(&v, 1));
        ASSERT_EQ(trianglesOf(treeOf(lattice, set).whole().mesh), trianglesOf(meshOf(lattice, set)))
            << width << " x " << height << ", vertex " << v;
      }
    }
}

/// Of at least three corners, within the grid.
std::vector<MapPoint> randomConvexPolygon(double right, double bottom, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double cx = unit(random) * right, cy = unit(random) * bottom;
  const double radius = unit(random) * std::max(right, bottom) / 2;
  const int corners = 3 + static_cast<int>(random() % 5);
  std::vector<double> angles;
  for (int i = 0; i < corners; ++i) angles.push_back(unit(random) * 6.283185307179586);
  std::sort(angles.begin(), angles.end());
  std::vector<MapPoint> polygon;  // on an ellipse that is squeezed into the grid: convex
  for (const double angle : angles) {
    const double rx = std::min({radius, cx, right - cx}), ry = std::min({radius, cy, bottom - cy});
    polygon.push_back({cx + rx * std::cos(angle), cy + ry * std::sin(angle)});
  }
  return polygon;
}

/// Whether a line separates the interiors of two convex polygons: an edge of one of them does.
bool apart(std::span<const MapPoint> p, std::span<const MapPoint> q) {
  for (size_t i = 0; i < p.size(); ++i) {
    const MapPoint a = p[i], b = p[(i + 1) % p.size()];
    const double nx = b.y - a.y, ny = a.x - b.x;
    const auto range = [&](std::span<const MapPoint> points) {
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (const MapPoint& point : points) {
        low = std::min(low, point.x * nx + point.y * ny);
        high = std::max(high, point.x * nx + point.y * ny);
      }
      return std::pair(low, high);
    };
    const auto [low_p, high_p] = range(p);
    const auto [low_q, high_q] = range(q);
    if (high_p <= low_q + 1e-9 || high_q <= low_p + 1e-9) return true;
  }
  return false;
}

bool overlaps(std::span<const MapPoint> p, std::span<const MapPoint> q) {
  return !apart(p, q) && !apart(q, p);
}

std::array<MapPoint, 3> cornersOf(const Triangle& triangle, uint32_t width) {
  std::array<MapPoint, 3> corners;
  for (size_t k = 0; k < 3; ++k)
    corners[k] = {static_cast<double>(triangle[k] % width),
                  static_cast<double>(triangle[k] / width)};
  return corners;
}

TEST_P(EverySize, AViewHoldsEveryTriangleThatItSeesAndInventsNone) {
  const uint32_t width = lattice_.width();
  const std::vector<VertexId> set = randomClosedSet(lattice_, 0.02, 4);
  const MeshTree tree = treeOf(lattice_, set);
  const std::set<Triangle> all = trianglesOf(meshOf(lattice_, set));
  std::mt19937 random(8);
  for (int round = 0; round < 20; ++round) {
    const std::vector<MapPoint> polygon =
        randomConvexPolygon(width - 1, lattice_.height() - 1, random);
    const ViewMesh view = tree.view(polygon);
    const std::set<Triangle> seen = trianglesOf(view.mesh);
    expectHeights(view);
    ASSERT_EQ(seen.size() * 3, view.mesh.triangles.size());
    ASSERT_TRUE(std::includes(all.begin(), all.end(), seen.begin(), seen.end()));
    for (const Triangle& triangle : all) {
      if (overlaps(cornersOf(triangle, width), polygon)) {
        ASSERT_TRUE(seen.contains(triangle)) << "round " << round;
      }
    }
    const std::set<uint32_t> used(view.mesh.triangles.begin(), view.mesh.triangles.end());
    ASSERT_EQ(used.size(), view.mesh.vertices.size());
  }
}

TEST(MeshTree, AWindowOfTheFullMeshHasTheTrianglesOfItsQuadrantsOnly) {
  const Lattice lattice = latticeOf({129, 129});
  std::vector<VertexId> all(lattice.vertexCount());
  for (VertexId v = 0; v < all.size(); ++v) all[v] = v;
  const MeshTree tree = treeOf(lattice, all);
  const MapPoint window[] = {{40.5, 20.5}, {40.5, 30.5}, {50.5, 30.5}, {50.5, 20.5}};
  EXPECT_EQ(tree.view(window).mesh.triangleCount(), 2u * 11 * 11);
  EXPECT_EQ(tree.view({}).mesh.triangleCount(), 0u);
}

TEST(ViewRaster, SpansOfEveryLevelAreTheSquaresThatThePolygonTouches) {
  constexpr QuadtreeShape kShape{5, 2, 1};
  std::mt19937 random(3);
  for (int round = 0; round < 100; ++round) {
    const std::vector<MapPoint> polygon = randomConvexPolygon(64, 32, random);
    const ViewRaster raster(kShape, polygon);
    for (uint32_t level = 0; level <= kShape.depth; ++level) {
      const double side = 32 >> level;
      for (uint32_t row = 0; row < kShape.rowsOf(level); ++row)
        for (uint32_t column = 0; column < kShape.columnsOf(level); ++column) {
          const double x = column * side, y = row * side, e = 1e-4;
          const auto square = [&](double by) {
            return std::array<MapPoint, 4>{{{x - by, y - by},
                                            {x - by, y + side + by},
                                            {x + side + by, y + side + by},
                                            {x + side + by, y - by}}};
          };
          const bool touched = raster.touches({level, column, row});
          ASSERT_TRUE(touched || !overlaps(square(-e), polygon));
          ASSERT_TRUE(!touched || overlaps(square(e), polygon));
        }
    }
  }
}

/// Clip coordinates of a pinhole camera; axes: to the right, up, forward.
std::array<double, 16> cameraClip(const std::array<double, 3>& eye,
                                  const std::array<std::array<double, 3>, 3>& axes,
                                  double tangent) {
  std::array<double, 16> clip{};
  for (size_t row = 0; row < 4; ++row) {
    const std::array<double, 3>& axis = axes[row == 3 ? 2 : row];
    const double scale = row < 2 ? 1 / tangent : 1;
    for (size_t k = 0; k < 3; ++k) {
      clip[4 * row + k] = scale * axis[k];
      clip[4 * row + 3] -= scale * axis[k] * eye[k];
    }
  }
  return clip;
}

/// Right, up and forward in any directions, by Gram-Schmidt.
std::array<std::array<double, 3>, 3> randomAxes(std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::array<std::array<double, 3>, 3> axes;
  for (size_t i = 0; i < 3; ++i) {
    for (double& c : axes[i]) c = normal(random);
    for (size_t j = 0; j < i; ++j) {
      double along = 0;
      for (size_t k = 0; k < 3; ++k) along += axes[i][k] * axes[j][k];
      for (size_t k = 0; k < 3; ++k) axes[i][k] -= along * axes[j][k];
    }
    const double length = std::hypot(axes[i][0], axes[i][1], axes[i][2]);
    for (double& c : axes[i]) c /= length;
  }
  return axes;
}

bool isInside(const std::vector<MapPoint>& polygon, double x, double y) {
  bool inside = polygon.size() >= 3;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const MapPoint a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    inside &= (b.y - a.y) * (x - a.x) - (b.x - a.x) * (y - a.y) >= -1e-6;
  }
  return inside;
}

/// By how much a point of the ground is inside the picture, in w, at the height of the box where
/// that is most.
double roomInPicture(const std::array<double, 16>& clip, const MapBox& box, double x, double y) {
  double most = -HUGE_VAL;
  for (int step = 0; step <= 400; ++step) {
    const double h = box.low + (box.high - box.low) * step / 400;
    std::array<double, 4> c;
    for (size_t row = 0; row < 4; ++row)
      c[row] =
          clip[4 * row] * x + clip[4 * row + 1] * y + clip[4 * row + 2] * h + clip[4 * row + 3];
    most = std::max(most, c[3] - std::max(std::abs(c[0]), std::abs(c[1])));
  }
  return most;
}

// Any camera, also between the lowest and the highest ground and looking at the sky: a point of the
// box is in its picture exactly if (for some height) it is in the footprint.
TEST(ViewFootprint, IsTheShadowOfWhatACameraSees) {
  const MapBox box{100, 60, -20, 30};
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 200; ++round) {
    const auto axes = randomAxes(random);
    const std::array<double, 3> eye{unit(random) * 140 - 20, unit(random) * 100 - 20,
                                    unit(random) * 120 - 40};
    const auto clip = cameraClip(eye, axes, 0.2 + unit(random));
    const std::vector<MapPoint> polygon = viewFootprint(clip, box);
    for (int i = 0; i < 100; ++i) {
      const double x = unit(random) * box.right, y = unit(random) * box.bottom;
      const double room = roomInPicture(clip, box, x, y);
      const bool between_heights = room < 0 && room >= -1;
      if (between_heights) continue;
      ASSERT_EQ(isInside(polygon, x, y), room >= 0) << "round " << round;
    }
  }
}

}  // namespace
}  // namespace tetrakis
