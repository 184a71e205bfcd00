// SPDX-License-Identifier: Apache-2.0
// Meshes of few triangles, made of coarse levels, against those of the whole surface.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <span>

#include "codec/mesh/fitted_heights.hpp"
#include "codec/mesh/topology/lattice_mesh.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using samples::Pattern;
using samples::Raster;

constexpr std::pair<uint32_t, uint32_t> kSizes[] = {{129, 129}, {150, 131}, {97, 200}};

std::vector<int32_t> heightsOf(const Raster& raster) {
  std::vector<int32_t> heights;
  for (size_t i = 0; i < size_t{raster.width} * raster.height; ++i)
    heights.push_back(static_cast<int32_t>(sampleAt(raster.data, raster.sample, i)));
  return heights;
}

struct DrawnMesh {
  LatticeMesh mesh;
  std::vector<double> heights;
};

DrawnMesh decode(Stream& stream, uint32_t triangles) {
  tks_mesh mesh = {};
  EXPECT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_BUDGET, triangles, &mesh), TKS_OK)
      << tks_message(stream.get());
  DrawnMesh drawn;
  drawn.mesh.vertices.assign(mesh.grid_index, mesh.grid_index + mesh.vertex_count);
  drawn.mesh.triangles.assign(mesh.triangles, mesh.triangles + 3 * size_t{mesh.triangle_count});
  drawn.heights.assign(mesh.height, mesh.height + mesh.vertex_count);
  tks_free_mesh(&mesh);
  return drawn;
}

/// Root mean squared, over all samples.
double errorOf(const DrawnMesh& drawn, const std::vector<int32_t>& surface, uint32_t width) {
  std::vector<double> shown(surface.size());
  for (size_t t = 0; t < drawn.mesh.triangles.size(); t += 3) {
    const uint32_t* corners = &drawn.mesh.triangles[t];
    std::array<GridPoint, 3> points;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t sample = drawn.mesh.vertices[corners[k]];
      points[k] = {sample % width, sample / width};
    }
    const TriangleSamples samples(points);
    samples.forEach([&](uint32_t x, uint32_t y, const TriangleSamples::Edges& e) {
      double height = 0;
      for (size_t k = 0; k < 3; ++k)
        height += static_cast<double>(e[k]) * drawn.heights[corners[k]];
      shown[y * width + x] = height / static_cast<double>(samples.doubledArea());
    });
  }
  double sum = 0;
  for (size_t i = 0; i < surface.size(); ++i)
    sum += (shown[i] - surface[i]) * (shown[i] - surface[i]);
  return std::sqrt(sum / static_cast<double>(surface.size()));
}

TEST(BudgetMesh, IsAboutAsGoodAsOneChosenAmongAllSamples) {
  for (const auto& [width, height] : kSizes) {
    const Raster raster = samples::make({Pattern::kRidges, width, height, 1, TKS_U16, 7});
    const std::vector<int32_t> surface = heightsOf(raster);
    const Bytes bytes = encode(&raster, nullptr, lossless());
    Stream stream(bytes);
    const Result<FittedSequence> sequence = FittedSequence::make({{width, height, surface}, {}});
    for (const uint32_t triangles : {20u, 70u, 300u, 1000u, 5000u}) {
      SCOPED_TRACE(testing::Message() << width << " x " << height << ", " << triangles);
      const DrawnMesh drawn = decode(stream, triangles);
      checks::expectConforming(drawn.mesh, width, height);
      EXPECT_LE(drawn.mesh.triangleCount(), triangles);
      EXPECT_GE(drawn.mesh.triangleCount() + 3, triangles);
      const FittedMesh best = sequence->mesh(sequence->longestPrefix(triangles));
      EXPECT_LE(errorOf(drawn, surface, width),
                1.06 * errorOf({best.mesh, best.heights}, surface, width));
    }
  }
}

/// Almost so where the last column or row is none of the level's.
/// A fit overshoots at the foot of a cliff: not below the sea, nor above the land. Of fewer
/// triangles that holds for the mip level that they are fitted to.
TEST(BudgetMesh, StaysWithinTheRangeOfTheSurface) {
  Raster cliffs = samples::make({Pattern::kRidges, 129, 90, 1, TKS_I16});
  const std::vector<int32_t> ridges = heightsOf(cliffs);
  std::vector<int32_t> sorted = ridges;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  const int32_t sea = sorted[sorted.size() / 2];
  auto* heights = reinterpret_cast<int16_t*>(cliffs.data.data());
  for (const int32_t ridge : ridges) *heights++ = ridge > sea ? int16_t{900} : int16_t{0};
  const Bytes bytes = encode(&cliffs, nullptr, lossless());
  Stream stream(bytes);
  for (const uint32_t triangles : {700u, 1000u, 5000u}) {
    tks_mesh mesh = {};
    ASSERT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_BUDGET, triangles, &mesh), TKS_OK);
    for (uint32_t v = 0; v < mesh.vertex_count; ++v) {
      EXPECT_GE(mesh.height[v], 0) << triangles;
      EXPECT_LE(mesh.height[v], 900) << triangles;
    }
    tks_free_mesh(&mesh);
  }
}

/// What is under water shows nothing, however much the budget has left.
/// What is decoded, or fitted, may lie beyond the largest floats, which samples may be.
TEST(BudgetMesh, HasFiniteHeights) {
  Raster raster{96, 40, 1, TKS_F32, {}};
  for (uint32_t i = 0; i < 96 * 40; ++i) {
    const bool high = samples::valueNoise(i % 96, i / 96, 4, 3) > 32768;
    const float sample = (high ? 1 : -1) * FLT_MAX * static_cast<float>(i % 7 < 6 ? 1 : 0.9);
    const auto bytes = std::as_bytes(std::span(&sample, 1));
    raster.data.insert(raster.data.end(), bytes.begin(), bytes.end());
  }
  const Bytes bytes = encodeHeights(raster.heights(), budget(700));
  for (const size_t size : {bytes.size(), bytes.size() / 2}) {
    Stream stream(Prefix(bytes).first(size));
    std::vector<float> heights(96 * 40);
    ASSERT_EQ(tks_decode_surface(stream.get(), heights.data(), heights.size()), TKS_OK);
    for (const uint32_t triangles : {20u, 200u, 2000u, 0u}) {
      const DrawnMesh drawn = decode(stream, triangles);
      for (const double height : drawn.heights) heights.push_back(static_cast<float>(height));
    }
    const auto finite = [](float height) { return std::isfinite(height); };
    EXPECT_TRUE(std::all_of(heights.begin(), heights.end(), finite)) << size;
  }
}

TEST(BudgetMesh, HasNoVerticesOnWaterThatNothingNeeds) {
  for (const auto& [width, height] :
       {std::pair{129u, 129u}, {150u, 131u}, {97u, 200u}, {70u, 33u}}) {
    Raster island = samples::make({Pattern::kFlat, width, height, 1, TKS_I16});
    const Bytes plane = encode(&island, nullptr, lossless());
    for (uint32_t y = 0; y < height; ++y)
      for (uint32_t x = width - 20; x < width - 3; ++x)
        island.data[2 * (size_t{y} * width + x)] = static_cast<std::byte>(x * x + 7 * y);
    const std::vector<int32_t> surface = heightsOf(island);
    const Bytes bytes = encode(&island, nullptr, lossless());
    const uint64_t all = uint64_t{2} * (width - 1) * (height - 1);
    for (const uint32_t triangles : {1000u, 1u << 20}) {
      SCOPED_TRACE(testing::Message() << width << " x " << height << ", " << triangles);
      Stream water(plane), land(bytes);
      const DrawnMesh flat = decode(water, triangles), drawn = decode(land, triangles);
      checks::expectConforming(flat.mesh, width, height);
      checks::expectConforming(drawn.mesh, width, height);
      EXPECT_LE(flat.mesh.triangleCount(), 2 * (width / (height - 1) + height / (width - 1) + 1));
      if (triangles < all) continue;
      EXPECT_EQ(errorOf(drawn, surface, width), 0);
      EXPECT_LT(drawn.mesh.triangleCount(), all * 9 / 10);
    }
  }
}

TEST(BudgetMesh, PlanesComeBackFromAnyLevel) {
  for (const auto& [width, height] : kSizes) {
    const Raster raster = samples::make({Pattern::kRamp, width, height, 1, TKS_U16, 1});
    const std::vector<int32_t> surface = heightsOf(raster);
    const auto [low, high] = std::minmax_element(surface.begin(), surface.end());
    const double bound = width == 129 ? 1 : 0.004 * (*high - *low);
    const Bytes bytes = encode(&raster, nullptr, lossless());
    Stream stream(bytes);
    for (const uint32_t triangles : {8u, 60u, 500u, 4000u})
      EXPECT_LT(errorOf(decode(stream, triangles), surface, width), bound)
          << width << " x " << height << ", " << triangles;
  }
}

/// What is made of a level does not depend on what was decoded before.
TEST(BudgetMesh, IsTheSameWhateverWasAskedBefore) {
  const Raster raster = samples::make({Pattern::kRidges, 150, 131, 1, TKS_U16, 3});
  const Bytes bytes = encode(&raster, nullptr, budget(3000));
  Stream fresh(bytes), used(bytes);
  static_cast<void>(used.heights());
  static_cast<void>(decode(used, 3000));
  const DrawnMesh first = decode(fresh, 100), second = decode(used, 100);
  EXPECT_EQ(first.mesh.vertices, second.mesh.vertices);
  EXPECT_EQ(first.heights, second.heights);
}

TEST(BudgetMesh, EveryPrefixAndBudgetMakesAMesh) {
  for (const auto& [width, height] : {std::pair{40u, 33u}, {3u, 70u}, {5u, 5u}, {2u, 2u}}) {
    const Raster raster = samples::make({Pattern::kRidges, width, height, 1, TKS_U16, 5});
    const Bytes bytes = encode(&raster, nullptr, lossless());
    const size_t header = Stream(bytes).info().header_bytes;
    for (size_t size = header; size <= bytes.size(); size += 1 + size / 9) {
      Stream stream(Prefix(bytes).first(size));
      for (const uint32_t triangles : {1u, 2u, 9u, 40u, 200u, 4000000000u})
        checks::expectConforming(decode(stream, triangles).mesh, width, height);
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
