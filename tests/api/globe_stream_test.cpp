// SPDX-License-Identifier: Apache-2.0
// tks_decode_globe: every prefix and any number of triangles, grids of all kinds, and what it
// refuses.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "tests/support/forest_raster.hpp"
#include "tests/support/forest_shapes.hpp"
#include "tests/support/globe_grids.hpp"
#include "tests/support/welded_mesh.hpp"

namespace tetrakis::test {
namespace {

using checks::WeldedMesh;
using samples::make;
using samples::Pattern;
using samples::Raster;
using Point = std::array<double, 3>;

Bytes streamOf(const Grid& grid, const tks_encode_options& options = lossless()) {
  const Raster raster = rasterOf(grid);
  return encodeHeights(placed(raster, grid), options);
}

struct Drawn {
  tks_status status = TKS_OK;
  std::vector<Point> points;
  std::vector<std::array<double, 2>> pixels;
  std::vector<float> heights;
  std::vector<uint32_t> triangles;

  WeldedMesh welded() const { return checks::weldedMesh(points, triangles); }
};

Drawn draw(Stream& stream, tks_mesh_kind kind, uint32_t max_triangles,
           const tks_globe& globe = moon()) {
  tks_globe_mesh mesh = {};
  Drawn drawn;
  drawn.status = tks_decode_globe(stream.get(), kind, max_triangles, &globe, &mesh);
  for (uint32_t v = 0; v < mesh.vertex_count; ++v) {
    const double* p = mesh.position + 3 * size_t{v};
    drawn.points.push_back({p[0], p[1], p[2]});
    drawn.pixels.push_back({mesh.pixel[2 * size_t{v}], mesh.pixel[2 * size_t{v} + 1]});
  }
  drawn.heights.assign(mesh.height, mesh.height + mesh.vertex_count);
  drawn.triangles.assign(mesh.triangles, mesh.triangles + 3 * size_t{mesh.triangle_count});
  tks_free_globe_mesh(&mesh);
  return drawn;
}

/// Six times the volume that each triangle spans with the centre is positive. At a pole it may be
/// nothing: where the grid has a shorter last row of squares, two corners lie on one meridian.
void expectOutwards(const Drawn& drawn) {
  const auto is_pole = [](const Point& p) { return p[0] == 0 && p[1] == 0; };
  for (size_t t = 0; t < drawn.triangles.size(); t += 3) {
    const Point &a = drawn.points[drawn.triangles[t]], &b = drawn.points[drawn.triangles[t + 1]],
                &c = drawn.points[drawn.triangles[t + 2]];
    const double length = std::hypot(a[0], a[1], a[2]);
    const bool at_pole = is_pole(a) || is_pole(b) || is_pole(c);
    ASSERT_GT(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                  a[2] * (b[0] * c[1] - b[1] * c[0]),
              at_pole ? -1e-12 * length * length * length : 0);
  }
}

TEST(GlobeStream, IsAClosedSphereAfterEveryByte) {
  for (const Grid& grid : {kAreas, kPoints, kSouthUp}) {
    const Bytes bytes = streamOf(grid);
    const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
    for (size_t size = header; size <= bytes.size(); size += size < header + 20 ? 1 : 37) {
      Stream stream(Prefix(bytes).first(size));
      for (const auto& [kind, triangles] :
           {std::pair{TKS_MESH_BUDGET, 0u}, {TKS_MESH_BUDGET, 90u}, {TKS_MESH_CODED, 0u}}) {
        const Drawn drawn = draw(stream, kind, triangles);
        ASSERT_EQ(drawn.status, TKS_OK) << tks_message(stream.get());
        const WeldedMesh welded = drawn.welded();
        ASSERT_EQ(welded.open, 0u) << size;
        ASSERT_EQ(welded.euler(), 2) << size;
        expectOutwards(drawn);
      }
      if (HasFatalFailure()) return;
    }
  }
}

TEST(GlobeStream, IsAClosedSphereOfAnyNumberOfTriangles) {
  for (const Grid& grid :
       {kAreas, kPoints, kSouthUp, Grid{360, 180, -180, 90, 1, -1},
        Grid{360, 181, -180, 90.5, 1, -1}, Grid{200, 101, 0, -90.9, -1.8, 1.8}}) {
    const Bytes bytes = streamOf(grid, budget(9000));
    Stream stream(bytes);
    for (const uint32_t triangles : {1u, 7u, 60u, 300u, 1000u, 4000u, 20000u, 400000u}) {
      SCOPED_TRACE(testing::Message() << grid.width << " x " << grid.height << ", " << triangles);
      const Drawn drawn = draw(stream, TKS_MESH_BUDGET, triangles);
      ASSERT_EQ(drawn.status, TKS_OK) << tks_message(stream.get());
      const WeldedMesh welded = drawn.welded();
      EXPECT_EQ(welded.open, 0u);
      EXPECT_EQ(welded.euler(), 2);
      const size_t ends = 2 * size_t{grid.width} + 2 * size_t{grid.height};
      EXPECT_LE(welded.triangles, triangles + std::max(triangles / 2, 400u) + ends);
      expectOutwards(drawn);
    }
  }
}

ForestRaster cubeRaster(int depth) {
  return {Forest(depth, cubeShape().sides), {Pattern::kRidges, 0, 0, 1, TKS_I16, 3}};
}

TEST(GlobeStream, OnACubeIsAClosedSphereOfAnyNumberOfTriangles) {
  for (const int depth : {1, 3, 6}) {
    const Bytes bytes = cubeRaster(depth).encoded(budget(uint64_t{1500} << depth));
    const auto header = static_cast<size_t>(Stream(bytes).info().header_bytes);
    for (const size_t size : {bytes.size(), std::max(header, bytes.size() / 3), header}) {
      Stream stream(Prefix(bytes).first(size));
      for (const uint32_t triangles : {1u, 60u, 1000u, 9000u, 400000u, 0u}) {
        SCOPED_TRACE(testing::Message() << "depth " << depth << ", " << triangles);
        const Drawn drawn =
            draw(stream, triangles > 0 ? TKS_MESH_BUDGET : TKS_MESH_CODED, triangles);
        ASSERT_EQ(drawn.status, TKS_OK) << tks_message(stream.get());
        const WeldedMesh welded = drawn.welded();
        EXPECT_EQ(welded.open, 0u);
        EXPECT_EQ(welded.euler(), 2);
        if (triangles > 0) {
          EXPECT_LE(welded.triangles, triangles + std::max(triangles / 2, 200u));
        }
        expectOutwards(drawn);
      }
    }
  }
}

/// Each vertex is a sample of the raster, at its height over the place that the projection gives.
TEST(GlobeStream, OnACubeHasTheSamplesWhereTheyLie) {
  const ForestRaster cube = cubeRaster(4);
  Stream stream(cube.encoded(lossless()));
  const Drawn drawn = draw(stream, TKS_MESH_BUDGET, 0);
  const std::vector<int16_t> samples = cube.samples<int16_t>();
  ASSERT_EQ(drawn.heights.size(), samples.size());
  for (size_t v = 0; v < samples.size(); ++v) {
    const auto x = static_cast<uint32_t>(drawn.pixels[v][0]),
               y = static_cast<uint32_t>(drawn.pixels[v][1]);
    EXPECT_EQ(drawn.heights[v], samples[17 * y + x]);
    const Point& p = drawn.points[v];
    EXPECT_NEAR(std::hypot(p[0], p[1], p[2]), 1737400 + drawn.heights[v], 1e-3);
    const auto is = [&](uint32_t column, uint32_t row, const Point& at) {
      if (x != column || y != row) return;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(p[k] / std::hypot(p[0], p[1], p[2]), at[k], 1e-12);
    };
    is(8, 8, {1, 0, 0});           // in the middle of the first patch: longitude 0
    is(8, 17 + 8, {0, 1, 0});      // of the second: 90 degrees east
    is(8, 4 * 17 + 8, {0, 0, 1});  // of the fifth: the north pole
    const double corner = 1 / std::sqrt(3.);
    is(0, 0, {corner, -corner, corner});
  }
}

TEST(GlobeStream, IsNoOtherForest) {
  const ForestRaster torus(Forest(3, torusShape().sides), {Pattern::kRidges, 0, 0, 1, TKS_I16, 3});
  Stream stream(torus.encoded(lossless()));
  EXPECT_EQ(draw(stream, TKS_MESH_BUDGET, 0).status, TKS_USAGE);
}

TEST(GlobeStream, IsOpenWhereTheGridEnds) {
  const Bytes bytes = streamOf(kBand);
  Stream stream(bytes);
  for (const uint32_t triangles : {0u, 200u, 3000u}) {
    const WeldedMesh welded = draw(stream, TKS_MESH_BUDGET, triangles).welded();
    EXPECT_EQ(welded.euler(), 0);
    EXPECT_EQ(welded.loops, 2u);
  }
}

TEST(GlobeStream, HasTheSamplesWhereTheyLie) {
  const Raster raster = rasterOf(kAreas);
  const Bytes bytes = encodeHeights(placed(raster, kAreas), lossless());
  Stream stream(bytes);
  tks_globe globe = moon();
  globe.exaggeration = 20;
  const Drawn drawn = draw(stream, TKS_MESH_BUDGET, 0, globe);
  std::set<std::array<double, 2>> seen;
  for (size_t v = 0; v < drawn.points.size(); ++v) {
    const auto [x, y, z] = drawn.points[v];
    const auto [column, row] = drawn.pixels[v];
    EXPECT_NEAR(std::hypot(x, y, z), 1737400 + 20.0 * drawn.heights[v], 1e-6);
    if (row == 0 || row == 18) continue;
    const auto sample = static_cast<size_t>(row) * 36 + static_cast<size_t>(column) % 36;
    EXPECT_EQ(drawn.heights[v], sampleAt(raster.data, TKS_I16, sample));
    const double longitude = std::atan2(y, x) * 180 / std::acos(-1);
    EXPECT_NEAR(std::remainder(longitude - (-180 + 10 * column), 360), 0, 1e-9);
    seen.insert({column, row});
  }
  EXPECT_EQ(seen.size(), 37u * 18);
}

TEST(GlobeStream, LeavesOutVoidsAndNothingElse) {
  const Raster raster = rasterOf(kAreas);
  tks_heights heights = placed(raster, kAreas);
  heights.has_nodata = 1;
  heights.nodata = sampleAt(raster.data, TKS_I16, 5 * 36 + 35);
  const Bytes bytes = encodeHeights(heights, lossless());
  Stream stream(bytes);
  const std::vector<uint8_t> valid = stream.validity();
  for (const uint32_t triangles : {0u, 60u, 400u}) {
    const Drawn drawn = draw(stream, TKS_MESH_BUDGET, triangles);
    ASSERT_EQ(drawn.status, TKS_OK);
    EXPECT_GT(drawn.welded().open, 0u);
    for (const auto& [column, row] : drawn.pixels) {
      if (row == 0 || row == 18) continue;
      EXPECT_EQ(valid[static_cast<size_t>(row) * 36 + static_cast<size_t>(column) % 36], 1);
    }
  }
}

TEST(GlobeStream, RefusesWhatGoesRoundNoGlobe) {
  const auto refused = [](const Bytes& bytes, const tks_globe& globe) {
    Stream stream(bytes);
    return draw(stream, TKS_MESH_BUDGET, 0, globe).status == TKS_USAGE &&
           *tks_message(stream.get()) != 0;
  };
  const Raster raster = rasterOf(kAreas);
  EXPECT_TRUE(refused(encode(&raster, nullptr, lossless()), moon()));
  for (const Grid& grid : {Grid{36, 18, 0, 90, 5, -10}, Grid{37, 18, 0, 90, 10, -10},
                           Grid{36, 18, 0, 120, 10, -10}, Grid{36, 18, 0, 90, 10, 0}})
    EXPECT_TRUE(refused(streamOf(grid), moon())) << grid.row;
  const Bytes bytes = streamOf(kAreas);
  EXPECT_FALSE(refused(bytes, moon()));
  for (const tks_globe& globe :
       {tks_globe{sizeof(tks_globe), 0, 1, 0, 0}, tks_globe{sizeof(tks_globe), 1, -1, 0, 0},
        tks_globe{sizeof(tks_globe), 1, NAN, 0, 0}, tks_globe{sizeof(tks_globe), 1, 1, 2, 0},
        tks_globe{sizeof(tks_globe), 1, 1, 1, INFINITY}, tks_globe{8, 1, 1, 1, 1}})
    EXPECT_TRUE(refused(bytes, globe));
  Stream stream(bytes);
  const tks_globe globe = moon();
  tks_globe_mesh mesh = {};
  EXPECT_EQ(tks_decode_globe(stream.get(), TKS_MESH_BUDGET, 0, nullptr, &mesh), TKS_USAGE);
  EXPECT_EQ(tks_decode_globe(stream.get(), TKS_MESH_BUDGET, 0, &globe, nullptr), TKS_USAGE);
  EXPECT_EQ(tks_decode_globe(nullptr, TKS_MESH_BUDGET, 0, &globe, &mesh), TKS_USAGE);
  tks_free_globe_mesh(nullptr);
}

/// Of a grid in grads.
TEST(GlobeStream, TakesTheUnitOfTheAngles) {
  const Bytes bytes = streamOf({40, 20, -200, 100, 10, -10});
  Stream stream(bytes);
  tks_globe globe = moon();
  EXPECT_EQ(draw(stream, TKS_MESH_BUDGET, 0, globe).status, TKS_USAGE);
  globe.degrees = 0.9;
  EXPECT_EQ(draw(stream, TKS_MESH_BUDGET, 0, globe).welded().euler(), 2);
}

}  // namespace
}  // namespace tetrakis::test
