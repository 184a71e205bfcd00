// SPDX-License-Identifier: Apache-2.0
// Meshes for cameras: weights from pictures, edges that turn.
#include "codec/mesh/meshes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "codec/mesh/fitted_heights.hpp"
#include "codec/mesh/fitting/fitting.hpp"
#include "codec/mesh/screen/surface_picture.hpp"
#include "tests/support/decimation_terrain.hpp"
#include "tests/support/mesh_checks.hpp"

namespace tetrakis {
namespace {

using checks::Relief;
using checks::Terrain;

Status anyNumber(uint64_t) {
  return {};
}

/// Looks straight down on columns x to x + side and rows y to y + side, whatever the heights.
ScreenView mapOf(double x, double y, double side, uint32_t pixels = 64) {
  ScreenView view{pixels, pixels, {}, 1};
  view.clip = {2 / side, 0, 0, -2 * x / side - 1, 0, -2 / side, 0, 2 * y / side + 1, 0, 0, 0, 0, 0,
               0,        0, 1};
  return view;
}

/// The same, from the side: what is higher moves up in the picture, a pixel for each 10 steps.
ScreenView slanted(ScreenView view) {
  view.clip[6] = 2.0 / view.height / 10;
  return view;
}

/// Noise seen from the side: each triangle crosses the whole picture. Drawn one by one they would
/// take minutes.
TEST(SurfacePicture, NoiseTakesTimeForSamplesAndPixels) {
  constexpr uint32_t kSide = 600, kPixels = 1400;
  std::vector<int32_t> heights(kSide * kSide);
  uint32_t state = 1;
  for (int32_t& h : heights) h = static_cast<int32_t>((state = state * 1664525 + 1013904223) >> 16);
  const std::vector<uint8_t> valid;
  const WeightedSurface surface{{kSide, kSide, heights}, valid};
  ScreenView view = mapOf(0, 0, kSide, kPixels);
  view.clip[2] = view.clip[6] = 2.0 / 65536;
  view.clip[3] -= 1;
  view.clip[7] -= 1;
  const SurfacePicture picture(surface, view, {});
  EXPECT_GT(picture.covered(), size_t{kPixels} * kPixels / 4);
}

/// Over the samples, each by its weight; vertices count as often as the surface says.
double errorOf(const WeightedSurface& surface, const FittedMesh& fitted) {
  const uint32_t width = surface.view.width;
  const auto& [vertices, triangles] = fitted.mesh;
  double error = 0;
  for (size_t t = 0; t < triangles.size(); t += 3) {
    HeldTriangle held;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t v = triangles[t + k];
      held.corners[k] = {vertices[v] % width, vertices[v] / width};
      held.heights[k] = fitted.heights[v];
    }
    error += squaredErrorOf(surface, held);
  }
  for (size_t v = 0; v < vertices.size(); ++v) {
    const double own = surface.view.heights[vertices[v]] - fitted.heights[v];
    error += surface.weightOf(vertices[v]) * own * own;
  }
  return error;
}

constexpr std::pair<uint32_t, uint32_t> kSizes[] = {{2, 2}, {2, 9}, {33, 33}, {40, 25}, {65, 31}};

TEST(TurnedEdges, KeepVerticesAndCoverTheGroundWithLessError) {
  for (const auto& [width, height] : kSizes)
    for (const Relief relief : {Relief::kFlat, Relief::kTerrain, Relief::kNoise, Relief::kExtreme})
      for (const uint32_t triangles : {2u, 30u, 200u, 100000u}) {
        SCOPED_TRACE(testing::Message() << width << " x " << height << ", " << triangles);
        const Terrain terrain(width, height, relief);
        const WeightedSurface surface{terrain.view(), {}};
        const auto sequence = FittedSequence::makeFor(surface, triangles);
        ASSERT_TRUE(sequence.ok());
        const FittedMesh before = sequence->mesh(sequence->longestPrefix(triangles));
        const FittedMesh turned = withTurnedEdges(surface, before);
        EXPECT_EQ(turned.mesh.vertices, before.mesh.vertices);
        EXPECT_EQ(turned.mesh.triangles.size(), before.mesh.triangles.size());
        checks::expectConforming(turned.mesh, width, height);
        const double error = errorOf(surface, before);
        EXPECT_LE(errorOf(surface, turned), error * (1 + 1e-9));
      }
}

TEST(TurnedEdges, LeaveAPlaneAsItIs) {
  const Terrain terrain(33, 33, Relief::kPlane);
  const WeightedSurface surface{terrain.view(), {}};
  const auto sequence = FittedSequence::makeFor(surface, 100);
  ASSERT_TRUE(sequence.ok());
  const FittedMesh before = sequence->mesh(sequence->longestPrefix(100));
  const FittedMesh turned = withTurnedEdges(surface, before);
  EXPECT_EQ(turned.mesh.triangles, before.mesh.triangles);
}

TEST(TurnedEdges, FollowACrestThatTheLatticeDoesNot) {
  Terrain terrain(65, 65, Relief::kFlat);
  for (int32_t y = 0; y < 65; ++y)
    for (int32_t x = 0; x < 65; ++x)
      terrain.heights[static_cast<size_t>(y * 65 + x)] = -100 * std::abs(3 * x - y - 40);
  const WeightedSurface surface{terrain.view(), {}};
  const auto sequence = FittedSequence::makeFor(surface, 120);
  ASSERT_TRUE(sequence.ok());
  const FittedMesh before = sequence->mesh(sequence->longestPrefix(120));
  const FittedMesh turned = withTurnedEdges(surface, before);
  EXPECT_LT(errorOf(surface, turned), 0.7 * errorOf(surface, before));
}

TEST(TurnedEdges, TouchNoUnknownGround) {
  const Terrain terrain(49, 38, Relief::kTerrain);
  std::vector<uint8_t> known(terrain.heights.size(), 1);
  for (size_t i = 0; i < known.size(); ++i) known[i] = i % 49 < 20 || i / 49 > 15;
  const WeightedSurface surface{terrain.view(), known};
  const auto lattice = Lattice::make(49, 38);
  for (const uint32_t triangles : {20u, 200u, 3000u}) {
    const auto mesh = screenMesh(*lattice, surface, triangles, anyNumber);
    ASSERT_TRUE(mesh.ok());
    checks::expectConforming(mesh->mesh, 49, 38);
    size_t on_land = 0;
    for (size_t t = 0; t < mesh->mesh.triangles.size(); t += 3) {
      const auto land = [&](size_t k) {
        return known[mesh->mesh.vertices[mesh->mesh.triangles[t + k]]] != 0;
      };
      on_land += land(0) && land(1) && land(2);
    }
    EXPECT_LE(on_land, triangles);
  }
}

TEST(ScreenWeights, EqualWeightsGiveTodaysMeshBitForBit) {
  for (const auto& [width, height] : kSizes)
    for (const uint32_t triangles : {10u, 100u, 900u}) {
      const Terrain terrain(width, height, Relief::kTerrain);
      const WeightedSurface plain{terrain.view(), {}};
      const std::vector<float> ones(terrain.heights.size(), 1.0f);
      WeightedSurface weighted = plain;
      weighted.view.weights = ones;
      const auto a = FittedSequence::makeFor(plain, triangles);
      const auto b = FittedSequence::makeFor(weighted, triangles);
      ASSERT_TRUE(a.ok() && b.ok());
      const FittedMesh one = a->mesh(a->longestPrefix(triangles));
      const FittedMesh other = b->mesh(b->longestPrefix(triangles));
      EXPECT_EQ(one.mesh.vertices, other.mesh.vertices) << width << " x " << height;
      EXPECT_EQ(one.mesh.triangles, other.mesh.triangles);
      EXPECT_EQ(one.heights, other.heights);
    }
}

TEST(ScreenWeights, AreOneWhereNoCameraLooksOrAMapIsDrawn) {
  const Terrain terrain(33, 20, Relief::kTerrain);
  const WeightedSurface surface{terrain.view(), {}};
  const std::vector<float> ones(terrain.heights.size(), 1.0f);
  const ScreenView map = mapOf(0, 0, 32), beside = slanted(mapOf(100, 100, 32));
  EXPECT_EQ(screenWeights(surface, {{map}}, {}), ones);     // heights move nothing
  EXPECT_EQ(screenWeights(surface, {{beside}}, {}), ones);  // sees no ground
  ScreenView behind = map;
  behind.clip[15] = -1;
  EXPECT_EQ(screenWeights(surface, {{behind}}, {}), ones);
}

TEST(ScreenWeights, GroundOutOfViewKeepsASixtyFourthAndGetsFewTriangles) {
  const Terrain terrain(65, 65, Relief::kNoise);
  WeightedSurface surface{terrain.view(), {}};
  const std::vector<float> weights = screenWeights(surface, {{slanted(mapOf(0, -8, 32))}}, {});
  for (uint32_t y = 0; y < 65; ++y)
    for (uint32_t x = 40; x < 65; ++x) EXPECT_EQ(weights[y * 65 + x], 0x1p-6f);
  const auto lattice = Lattice::make(65, 65);
  const auto eastern = [&](const FittedMesh& mesh) {
    return std::count_if(mesh.mesh.vertices.begin(), mesh.mesh.vertices.end(),
                         [](uint32_t sample) { return sample % 65 > 40; });
  };
  const auto before = screenMesh(*lattice, surface, 1000, anyNumber);
  surface.view.weights = weights;
  const auto after = screenMesh(*lattice, surface, 1000, anyNumber);
  ASSERT_TRUE(before.ok() && after.ok());
  EXPECT_LT(4 * eastern(*after), eastern(*before));
}

TEST(ScreenWeights, HiddenGroundCountsAsLittleAsGroundOutOfView) {
  Terrain terrain(65, 65, Relief::kFlat);
  for (size_t i = 0; i < terrain.heights.size(); ++i)
    if (i / 65 >= 40) terrain.heights[i] = 600;  // a step of 60 pixels in front of the north
  const WeightedSurface surface{terrain.view(), {}};
  ScreenView view = slanted(mapOf(0, 0, 64, 128));
  view.clip[13] = -0x1p-10;  // the south is nearer
  const std::vector<float> weights = screenWeights(surface, {{view}}, {});
  EXPECT_EQ(weights[30 * 65 + 30], 0x1p-6f);
  EXPECT_GT(weights[50 * 65 + 30], 0.5f);
}

TEST(ScreenWeights, GroundWithoutDetailCountsLittle) {
  const Terrain terrain(65, 65, Relief::kFlat);
  const WeightedSurface surface{terrain.view(), {}};
  std::vector<uint8_t> texels(64 * 64, 128);
  for (size_t i = 0; i < texels.size(); ++i)
    if (i % 64 >= 40 && i / 64 % 2 == 0) texels[i] = 200;  // stripes across the shift in the east
  const GroundImage image(64, 64, texels);
  const std::vector<float> weights =
      screenWeights(surface, {{slanted(mapOf(-8, -8, 80, 80))}}, image);
  double west = 0, east = 0;
  for (uint32_t y = 10; y < 55; ++y) {
    for (uint32_t x = 5; x < 30; ++x) west += weights[y * 65 + x] / 25;
    for (uint32_t x = 45; x < 60; ++x) east += weights[y * 65 + x] / 15;
  }
  EXPECT_LT(10 * west, east);
}

TEST(ScreenWeights, AreMultiplesOfTheirUnitWhateverTheMatrix) {
  const Terrain terrain(21, 30, Relief::kExtreme);
  const WeightedSurface surface{terrain.view(), {}};
  std::minstd_rand random(5);
  for (int i = 0; i < 200; ++i) {
    ScreenView view{
        1 + static_cast<uint32_t>(random() % 50), 1 + static_cast<uint32_t>(random() % 50), {}, 1};
    for (double& m : view.clip)
      m = std::ldexp(static_cast<double>(random() % 2001) - 1000,
                     static_cast<int>(random() % 80) - 50);
    if (i % 20 == 0) view.clip[random() % 16] = std::numeric_limits<double>::max();
    for (const float w : screenWeights(surface, {{view}}, {})) {
      EXPECT_GE(w, 0x1p-6f);
      EXPECT_LE(w, 0x1p14f);
      EXPECT_EQ(w * 1024, std::floor(w * 1024));
    }
  }
}

TEST(ScreenMesh, NeverHasMoreTrianglesThanAsked) {
  for (const auto& [width, height] : kSizes) {
    const Terrain terrain(width, height, Relief::kTerrain);
    WeightedSurface surface{terrain.view(), {}};
    const std::vector<float> weights =
        screenWeights(surface, {{slanted(mapOf(0, 0, 30)), slanted(mapOf(3, 2, 5))}}, {});
    surface.view.weights = weights;
    const auto lattice = Lattice::make(width, height);
    const uint32_t base = 2 * lattice->rootColumns() * lattice->rootRows();
    for (const uint32_t triangles : {1u, 2u, 17u, 100u, 1000u, 1u << 30}) {
      const auto mesh = screenMesh(*lattice, surface, triangles, anyNumber);
      ASSERT_TRUE(mesh.ok());
      EXPECT_LE(mesh->mesh.triangleCount(), std::max(triangles, base));
      checks::expectConforming(mesh->mesh, width, height);
      EXPECT_EQ(std::set(mesh->mesh.vertices.begin(), mesh->mesh.vertices.end()).size(),
                mesh->heights.size());
    }
  }
}

}  // namespace
}  // namespace tetrakis
