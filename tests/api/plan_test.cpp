// SPDX-License-Identifier: Apache-2.0
// tks_plan: which bytes help a view.
#include <cmath>

#include "conformance/samples/header_seal.hpp"
#include "ratecontrol/receiver/ground_sight.hpp"
#include "tests/support/forest_raster.hpp"
#include "tests/support/forest_shapes.hpp"
#include "tests/support/indexed_terrain.hpp"
#include "tests/support/planned_ranges.hpp"

namespace tetrakis::test {
namespace {

using samples::make;
using samples::Pattern;
using samples::Raster;

/// Ranges neither overlap nor touch, unless only one of two helps.
void expectMerged(std::span<const tks_range> ranges) {
  for (const tks_range& a : ranges) {
    EXPECT_GT(a.size, 0u);
    for (const tks_range& b : ranges)
      EXPECT_FALSE(a.offset + a.size == b.offset && (a.gain > 0) == (b.gain > 0));
  }
}

/// From a cache of `known` bytes on, in steps of `step` bytes, while the view changes.
void expectCoverage(const IndexedTerrain& terrain, size_t known, uint64_t step) {
  const std::array<tks_screen_camera, 3> views = {mapOf(0, 0, 30, 20), alongRows(45, -20, 900),
                                                  mapOf(50, 40, 89, 69)};
  Stream stream(Prefix(terrain.bytes).first(known));
  std::vector<bool> there(terrain.bytes.size());
  std::fill(there.begin(), there.begin() + static_cast<ptrdiff_t>(known), true);
  for (size_t lap = 0;; ++lap) {
    const Ranges plan(stream, lap % 4 == 3 ? nullptr : &views[lap % 4], step, lap % 2 ? 500 : 0);
    ASSERT_LE(plan.bytes(), step);
    expectMerged(plan.all());
    if (plan.all().empty()) break;
    for (const tks_range& range : plan.all()) {
      for (uint64_t i = range.offset; i < range.offset + range.size; ++i) {
        ASSERT_FALSE(there[i]) << "asked twice for byte " << i;
        there[i] = true;
      }
      ASSERT_NO_FATAL_FAILURE(put(stream, terrain.bytes, range));
    }
    ASSERT_LT(lap, 10 * terrain.bytes.size());
  }
  EXPECT_EQ(std::count(there.begin(), there.end(), false), 0);
  EXPECT_EQ(tks_verify(stream.get()), TKS_OK) << tks_message(stream.get());
  EXPECT_EQ(squaredError(terrain.heights, stream.heights()), 0);
  EXPECT_EQ(squaredError(terrain.image, stream.texture()), 0);
}

TEST(Plan, CoversEveryByteOnceAndASecondLapIsEmpty) {
  const IndexedTerrain terrain;
  const size_t size = terrain.bytes.size();
  for (const size_t known : {terrain.header, terrain.header + 1, terrain.header + size / 5, size})
    for (const uint64_t step : {uint64_t{313}, uint64_t{4000}, UINT64_MAX})
      ASSERT_NO_FATAL_FAILURE(expectCoverage(terrain, known, step)) << known << " " << step;
}

/// Cameras know the raster of a forest, whose patches lie one below the other. It has more rows
/// than the ground that a plan looks at, and levels of another size.
TEST(Plan, ForestsAreCoveredAsWell) {
  for (const ForestShape& shape : forestShapes()) {
    const ForestRaster surface{Forest(6, shape.sides), {Pattern::kRidges, 0, 0, 1, TKS_I16, 3}};
    const Bytes bytes = surface.encoded(lossless());
    const tks_screen_camera view = mapOf(10, 20, 50, 60);
    Stream stream(Prefix(bytes).first(bytes.size() / 2));
    const Ranges plan(stream, &view, UINT64_MAX, 300);
    EXPECT_EQ(plan.bytes(), bytes.size() - bytes.size() / 2) << shape.name;
    for (const tks_range& range : plan.all()) ASSERT_NO_FATAL_FAILURE(put(stream, bytes, range));
    EXPECT_EQ(stream.heights(), surface.raster.data) << shape.name;
  }
}

TEST(Plan, WhatIsSeenComesFirst) {
  const Raster image = make({Pattern::kRidges, 128, 128, 3, TKS_U8});
  const Bytes bytes = encodeRegions(nullptr, &image, lossless());
  const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
  const tks_window corner = {70, 75, 40, 40};
  const tks_screen_camera view = mapOf(70, 75, 110, 115);
  Stream stream(Prefix(bytes).first(header));
  const size_t budget = bytes.size() / 10;
  const Ranges plan(stream, &view, budget);
  ASSERT_EQ(plan.bytes(), budget);
  for (const tks_range& range : plan.all()) ASSERT_NO_FATAL_FAILURE(put(stream, bytes, range));
  Stream prefix(Prefix(bytes).first(header + budget));
  EXPECT_LT(errorIn(image, stream.texture(), corner),
            0.4 * errorIn(image, prefix.texture(), corner));
  const Ranges rest(stream, &view, UINT64_MAX);
  EXPECT_EQ(rest.all().back().gain, 0);
}

/// Ground beside the picture lags behind, but not until all of the picture is exact.
TEST(Plan, WhatATurnWouldShowComesBeforeTheLastDetailOfThisView) {
  const Raster image = make({Pattern::kRidges, 128, 128, 3, TKS_U8});
  const Bytes bytes = encodeRegions(nullptr, &image, lossless());
  Stream stream(Prefix(bytes).first(static_cast<size_t>(Stream(bytes).info().header_bytes)));
  const tks_screen_camera view = mapOf(70, 75, 110, 115);
  const Ranges plan(stream, &view, UINT64_MAX);
  const auto helps = [](const tks_range& range) { return range.gain > 0; };
  const auto unseen = std::find_if_not(plan.all().begin(), plan.all().end(), helps);
  ASSERT_NE(unseen, plan.all().end());
  EXPECT_TRUE(std::any_of(unseen, plan.all().end(), helps));
}

TEST(Plan, DetailBelowAPixelAndBelowTheMeshComesLast) {
  const IndexedTerrain terrain;
  Stream stream(Prefix(terrain.bytes).first(terrain.header));
  const auto helpful = [&](const tks_screen_camera& view, uint32_t triangles) {
    const Ranges plan(stream, &view, UINT64_MAX, triangles);
    uint64_t bytes = 0;
    for (const tks_range& range : plan.all()) bytes += range.gain > 0 ? range.size : 0;
    return bytes;
  };
  tks_screen_camera near = mapOf(0, 0, 89, 69);
  near.clip[6] = 1e-5;  // parallax
  tks_screen_camera far = near;
  far.width = far.height = 6;
  EXPECT_LT(helpful(far, 0), helpful(near, 0));
  EXPECT_LT(helpful(near, 2), helpful(near, 0));
}

/// Of the same bytes a fraction of the requests, which bring nearly as much.
TEST(Plan, WhereRequestsCostSomethingThereAreFew) {
  const IndexedTerrain terrain;
  const tks_screen_camera view = alongRows(45, -20, 900);
  Stream stream(Prefix(terrain.bytes).first(terrain.header));
  const uint64_t budget = terrain.bytes.size() / 3;
  size_t before = SIZE_MAX;
  for (const uint64_t cost : {0, 50, 500, 5000}) {
    const Ranges plan(stream, &view, budget, 0, cost);
    EXPECT_LE(plan.bytes(), budget);
    EXPECT_GT(plan.bytes(), budget / 2) << cost;
    EXPECT_LE(plan.all().size(), before) << cost;
    before = plan.all().size();
  }
  EXPECT_LE(before, 2u);
}

/// All comes in steps from any cache, by fewer requests where they cost something.
TEST(Plan, EveryCostOfRequestsBringsTheWholeStream) {
  const IndexedTerrain terrain;
  const tks_screen_camera view = mapOf(0, 0, 30, 20);
  size_t free = 0;
  for (const uint64_t cost : {uint64_t{0}, uint64_t{300}, UINT64_MAX}) {
    Stream stream(Prefix(terrain.bytes).first(terrain.header + 100));
    size_t requests = 0;
    for (size_t lap = 0;; ++lap) {
      const Ranges plan(stream, &view, 4000, 0, cost);
      ASSERT_LE(plan.bytes(), 4000u);
      if (plan.all().empty()) break;
      requests += plan.all().size();
      for (const tks_range& range : plan.all())
        ASSERT_NO_FATAL_FAILURE(put(stream, terrain.bytes, range));
      ASSERT_LT(lap, terrain.bytes.size());
    }
    EXPECT_EQ(tks_verify(stream.get()), TKS_OK) << tks_message(stream.get());
    if (cost == 0) free = requests;
    if (cost > 0) {
      EXPECT_LT(requests, free) << cost;
    }
  }
}

TEST(Plan, CoversGroundOfAbsurdSpacing) {
  const IndexedTerrain terrain;
  tks_heights heights = terrain.heights.heights();
  const tks_image image = terrain.image.image();
  tks_encode_options options = lossless();
  options.regions = 16;
  options.index = 1;
  for (const double spacing : {1e-200, 1e200}) {
    heights.spacing_x = heights.spacing_y = spacing;
    const Bytes bytes = encodeGiven(&heights, &image, options);
    const tks_screen_camera view = alongRows(45, -20, 900);
    for (const uint64_t request : {0, 500}) {
      Stream stream(Prefix(bytes).first(terrain.header + 900));
      EXPECT_GT(Ranges(stream, &view, UINT64_MAX, 0, request).bytes(), 0u) << spacing;
    }
  }
}

TEST(Plan, WithoutAnIndexBytesComeInTheirOrder) {
  const Raster heights = make({Pattern::kRidges, 40, 31, 1, TKS_I16});
  const Bytes bytes = encode(&heights, nullptr, lossless());
  Stream stream(Prefix(bytes).first(100));
  const tks_screen_camera view = mapOf(0, 0, 10, 10);
  const Ranges plan(stream, &view, 50);
  ASSERT_EQ(plan.all().size(), 1u);
  EXPECT_EQ(plan.all()[0].offset, 100u);
  EXPECT_EQ(plan.all()[0].size, 50u);
  Stream whole(bytes);
  EXPECT_TRUE(Ranges(whole, &view, 50).all().empty());
}

TEST(Plan, BadViewsAreRefusedInASentence) {
  const IndexedTerrain terrain;
  Stream stream(Prefix(terrain.bytes).first(terrain.header));
  tks_ranges ranges = {};
  tks_fetch fetch = {sizeof fetch, 1000, 0, 0};
  const auto refused = [&](const tks_screen_camera& view, const std::string& part) {
    EXPECT_EQ(tks_plan(stream.get(), &view, &fetch, &ranges), TKS_USAGE);
    EXPECT_NE(std::string(tks_message(stream.get())).find(part), std::string::npos)
        << tks_message(stream.get());
    EXPECT_EQ(ranges.count, 0u);
  };
  tks_screen_camera view = mapOf(0, 0, 10, 10);
  view.clip[5] = std::nan("");
  refused(view, "The matrix of the view must be finite.");
  view = mapOf(0, 0, 10, 10);
  view.height = 0;
  refused(view, "The picture of the view");
  view = mapOf(0, 0, 10, 10);
  view.size = 3;
  refused(view, "The struct of the view takes a size of at least");
  EXPECT_EQ(tks_plan(stream.get(), nullptr, &fetch, nullptr), TKS_USAGE);
  EXPECT_EQ(tks_plan(stream.get(), nullptr, nullptr, &ranges), TKS_USAGE);
  EXPECT_EQ(tks_plan(nullptr, nullptr, &fetch, &ranges), TKS_USAGE);
  fetch.size = 7;
  EXPECT_EQ(tks_plan(stream.get(), nullptr, &fetch, &ranges), TKS_USAGE);
  view = mapOf(1000, 1000, 1010, 1010);  // sees nothing: a view like any other
  const Ranges nothing(stream, &view, UINT64_MAX);
  EXPECT_EQ(nothing.bytes(), terrain.bytes.size() - terrain.header);
  view = cameraOf({});  // all of the ground in no place
  EXPECT_EQ(Ranges(stream, &view, UINT64_MAX).bytes(), terrain.bytes.size() - terrain.header);
}

TEST(Plan, WallsHideWhatIsBehindThem) {
  CoarseGround ground{20, 20, 4, std::vector<float>(400, 0)};
  for (size_t x = 0; x < 20; ++x) ground.heights[8 * 20 + x] = 50;
  const tks_screen_camera low = alongRows(38, -10, 10), high = alongRows(38, -10, 4000);
  const auto seen = [&](const tks_screen_camera& camera, size_t row) {
    Eye eye{{}, camera.width, camera.height};
    std::copy_n(camera.clip, 16, eye.clip.begin());
    return sightOf(ground, eye)[row * 20 + 10].pixels > 0;
  };
  EXPECT_TRUE(seen(low, 4));
  EXPECT_TRUE(seen(low, 8));
  EXPECT_FALSE(seen(low, 12));
  EXPECT_FALSE(seen(low, 19));
  EXPECT_FALSE(seen(high, 4));  // below the picture
}

TEST(Plan, ATurnBringsWhatLiesBehindIntoThePicture) {
  const CoarseGround ground{20, 20, 4, std::vector<float>(400, 0)};
  const tks_screen_camera camera = alongRows(38, 39, 10);
  Eye eye{{}, camera.width, camera.height};
  std::copy_n(camera.clip, 16, eye.clip.begin());
  const auto now = sightOf(ground, eye), around = sightAround(ground, eye, 1);
  const size_t ahead = 16 * 20 + 10, behind = 3 * 20 + 9;
  EXPECT_GT(now[ahead].pixels, 0);
  EXPECT_EQ(now[behind].pixels, 0);
  EXPECT_NEAR(around[behind].pixels, around[ahead].pixels, 0.4 * around[ahead].pixels);
  Eye map{{}, 320, 200};
  std::copy_n(mapOf(0, 0, 80, 80).clip, 16, map.clip.begin());
  for (const GroundPoint& point : sightAround(ground, map, 1)) EXPECT_EQ(point.pixels, 0);
}

/// With the checksum repaired.
TEST(Plan, SurvivesEveryDamagedByte) {
  const Raster heights = make({Pattern::kRidges, 26, 9, 1, TKS_I16});
  const Raster image = make({Pattern::kSteps, 24, 5, 1, TKS_U8});
  const Bytes bytes = encodeRegions(&heights, &image, lossless());
  const tks_limits limits = smallLimits();
  const tks_screen_camera view = alongRows(13, -5, 90);
  const size_t header = static_cast<size_t>(Stream(bytes).info().header_bytes);
  for (size_t at = 0; at < bytes.size(); ++at) {
    for (const int flip : {0x01, 0x40, 0x90}) {
      Bytes damaged = bytes;
      damaged[at] = static_cast<uint8_t>(damaged[at] ^ flip);
      sealHeader(damaged);
      for (const size_t size : {header, bytes.size()}) {
        Stream stream(Prefix(damaged).first(size), &limits);
        if (stream.status() != TKS_OK) continue;
        tks_ranges ranges = {};
        const tks_fetch fetch = {sizeof fetch, 700, 30, flip == 0x40 ? uint64_t{100} : 0};
        tks_plan(stream.get(), &view, &fetch, &ranges);
        tks_free_ranges(&ranges);
        tks_buffer buffer = {};
        tks_reorder(stream.get(), &view, 1, &buffer);
        tks_free_buffer(&buffer);
      }
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
