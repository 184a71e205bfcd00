// SPDX-License-Identifier: Apache-2.0
// The globe through the C interface: grids to cubes and back, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "tests/support/forest_shapes.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

constexpr uint32_t kWidth = 64, kHeight = 32, kDepth = 4;
constexpr size_t kCubeSamples = 6 * 17 * 17;

class Globe : public testing::Test {
 protected:
  Globe() : heights_(size_t{kWidth} * kHeight), cube_(kCubeSamples, 7), back_(heights_.size(), 7) {
    grid_.size = sizeof grid_;
    grid_.width = kWidth;
    grid_.height = kHeight;
    const double transform[] = {-180, 5.625, 0, 90, 0, -5.625};
    std::copy_n(transform, 6, grid_.geotransform);
    for (size_t i = 0; i < heights_.size(); ++i) {
      const double x = static_cast<double>(i % kWidth), y = static_cast<double>(i / kWidth) + 0.5;
      heights_[i] =
          static_cast<float>(1000 * std::sin(y * 0.0981747704) * std::cos(x * 0.0981747704));
    }
  }
  tks_status toCube(uint32_t depth = kDepth) {
    return tks_cube_from_grid(&grid_, heights_.data(), depth, 1, cube_.data(), &largest_, &rmse_,
                              message_, sizeof message_);
  }
  tks_status toGrid(const tks_window* window = nullptr, uint32_t depth = kDepth) {
    return tks_grid_from_cube(cube_.data(), depth, &grid_, window, 1, back_.data(), message_,
                              sizeof message_);
  }
  void expectRefused(tks_status status, const char* word) {
    EXPECT_EQ(status, TKS_USAGE);
    EXPECT_NE(std::strstr(message_, word), nullptr) << message_;
    EXPECT_EQ(cube_, std::vector<float>(kCubeSamples, 7));
    EXPECT_EQ(back_, std::vector<float>(heights_.size(), 7));
  }

  tks_geographic_grid grid_ = {};
  std::vector<float> heights_, cube_, back_;
  double largest_ = -1, rmse_ = -1;
  char message_[128] = "";
};

TEST_F(Globe, CubesHaveTheirSides) {
  const std::vector<uint32_t> expected = cubeShape().sides;
  EXPECT_EQ(std::vector<uint32_t>(tks_cube_sides(), tks_cube_sides() + 24), expected);
}

TEST_F(Globe, DepthsSuitColumns) {
  EXPECT_EQ(tks_cube_depth(1), 1u);
  EXPECT_EQ(tks_cube_depth(8), 1u);
  EXPECT_EQ(tks_cube_depth(9), 2u);
  EXPECT_EQ(tks_cube_depth(1024), 8u);
  EXPECT_EQ(tks_cube_depth(1080), 9u);
  EXPECT_EQ(tks_cube_depth(UINT32_MAX), uint32_t{TKS_MOST_CUBE_DEPTH});
}

/// The windows of the faces hold what a window of the grid is made of, and a stream gives the grid
/// by them, of all levels.
TEST_F(Globe, WindowsOfTheGridTakePartsOfTheCube) {
  ASSERT_EQ(toCube(), TKS_OK) << message_;
  tks_heights heights = {};
  heights.size = sizeof heights;
  heights.width = 17;
  heights.height = 6 * 17;
  heights.sample = TKS_F32;
  heights.data = cube_.data();
  heights.scale = 1;
  heights.domain = TKS_DOMAIN_FOREST;
  heights.forest = {kDepth, 6, tks_cube_sides()};
  Stream stream(encodeHeights(heights, lossless()));
  for (uint32_t level = 0; level < 3; ++level) {
    ASSERT_EQ(tks_set_levels(stream.get(), level, 0), TKS_OK);
    const uint32_t side = (16u >> level) + 1;
    std::vector<float> cube(size_t{6} * side * side);
    ASSERT_EQ(tks_decode_surface(stream.get(), cube.data(), cube.size()), TKS_OK);
    for (const tks_window& window :
         {tks_window{0, 0, kWidth, kHeight}, {62, 3, 5, 9}, {30, 0, 2, 1}, {12, 15, 3, 3}}) {
      std::vector<float> whole(size_t{window.width} * window.height), parts = whole;
      ASSERT_EQ(tks_grid_from_cube(cube.data(), kDepth - level, &grid_, &window, 1, whole.data(),
                                   nullptr, 0),
                TKS_OK);
      ASSERT_EQ(tks_decode_grid(stream.get(), &grid_, &window, parts.data(), parts.size()), TKS_OK)
          << tks_message(stream.get());
      EXPECT_EQ(whole, parts);
      std::vector<tks_window> faces(6);
      ASSERT_EQ(tks_cube_windows(kDepth - level, &grid_, &window, faces.data(), nullptr, 0),
                TKS_OK);
      const auto isUsed = [](const tks_window& face) { return face.width > 0; };
      const auto used = std::count_if(faces.begin(), faces.end(), isUsed);
      EXPECT_EQ(used == 6, window.width == kWidth);
      EXPECT_GT(used, 0);
    }
  }
  float out = 0;
  const tks_window outside = {kWidth, 0, 1, 1}, one = {0, 0, 1, 1};
  EXPECT_EQ(tks_decode_grid(stream.get(), &grid_, &outside, &out, 1), TKS_USAGE);
  EXPECT_EQ(tks_decode_grid(stream.get(), &grid_, &one, &out, 2), TKS_USAGE);
  EXPECT_EQ(tks_decode_grid(stream.get(), nullptr, &one, &out, 1), TKS_USAGE);
  EXPECT_EQ(tks_decode_grid(stream.get(), &grid_, &one, nullptr, 1), TKS_USAGE);
  const samples::Raster flat = samples::make({samples::Pattern::kRidges, 9, 9, 1, TKS_I16});
  Stream plane(encodeHeights(flat.heights(), lossless()));
  EXPECT_EQ(tks_decode_grid(plane.get(), &grid_, &one, &out, 1), TKS_USAGE);
}

TEST_F(Globe, StatesTheErrorsOfItsGrid) {
  ASSERT_EQ(toCube(), TKS_OK) << message_;
  ASSERT_EQ(toGrid(), TKS_OK) << message_;
  double largest = 0;
  for (size_t i = 0; i < heights_.size(); ++i)
    largest = std::max(largest, std::abs(double{heights_[i]} - back_[i]));
  EXPECT_EQ(largest_, largest);
  EXPECT_LT(largest, 5);
  EXPECT_GT(rmse_, 0);
  EXPECT_LT(rmse_, largest);
  EXPECT_EQ(tks_cube_from_grid(&grid_, heights_.data(), kDepth, 0, cube_.data(), nullptr, nullptr,
                               nullptr, 0),
            TKS_OK);
}

TEST_F(Globe, WindowsAreThoseOfTheGrid) {
  ASSERT_EQ(toCube(), TKS_OK);
  ASSERT_EQ(toGrid(), TKS_OK);
  const std::vector<float> whole = back_;
  const tks_window window{60, 30, 4, 2};
  ASSERT_EQ(toGrid(&window), TKS_OK);
  for (uint32_t i = 0; i < 8; ++i)
    EXPECT_EQ(back_[i], whole[(window.y + i / 4) * kWidth + window.x + i % 4]);
}

TEST_F(Globe, WindowsGoOnBehindTheLastColumn) {
  ASSERT_EQ(toCube(), TKS_OK);
  ASSERT_EQ(toGrid(), TKS_OK);
  const std::vector<float> whole = back_;
  const tks_window window{60, 30, kWidth, 2};
  ASSERT_EQ(toGrid(&window), TKS_OK);
  for (uint32_t i = 0; i < 2 * kWidth; ++i)
    EXPECT_NEAR(back_[i],
                whole[(window.y + i / kWidth) * kWidth + (window.x + i % kWidth) % kWidth], 1e-3);
}

/// What a cube is encoded from, and what its stream gives back.
TEST_F(Globe, GoesThroughAStream) {
  ASSERT_EQ(toCube(), TKS_OK);
  tks_heights heights = {};
  heights.size = sizeof heights;
  heights.width = 17;
  heights.height = 6 * 17;
  heights.sample = TKS_F32;
  heights.data = cube_.data();
  heights.scale = 1;
  heights.domain = TKS_DOMAIN_FOREST;
  heights.forest = {kDepth, 6, tks_cube_sides()};
  heights.grid_width = kWidth;
  heights.grid_height = kHeight;
  std::copy_n(grid_.geotransform, 6, heights.geotransform);
  heights.has_geotransform = 1;
  tks_encode_options options = {};
  options.size = sizeof options;
  options.max_error = 0.5;
  tks_buffer stream = {};
  ASSERT_EQ(tks_encode(&heights, nullptr, &options, &stream, message_, sizeof message_), TKS_OK)
      << message_;
  tks_decoder* decoder = nullptr;
  ASSERT_EQ(tks_open(stream.data, stream.size, nullptr, &decoder, nullptr, 0), TKS_OK);
  tks_info info = {};
  info.size = sizeof info;
  EXPECT_EQ(tks_get_info(decoder, &info), TKS_OK);
  EXPECT_EQ(tks_decode_surface(decoder, cube_.data(), cube_.size()), TKS_OK);
  tks_geographic_grid grid = {};
  grid.size = sizeof grid;
  grid.width = info.grid_width;
  grid.height = info.grid_height;
  std::copy_n(info.geotransform, 6, grid.geotransform);
  EXPECT_EQ(tks_grid_from_cube(cube_.data(), info.forest.depth, &grid, nullptr, 1, back_.data(),
                               nullptr, 0),
            TKS_OK);
  tks_close(decoder);
  tks_free_buffer(&stream);
  for (size_t i = 0; i < heights_.size(); ++i) EXPECT_NEAR(back_[i], heights_[i], largest_ + 1);
}

TEST_F(Globe, RefusesWhatIsNoGrid) {
  const tks_geographic_grid good = grid_;
  const auto refuse = [&](const char* word) {
    expectRefused(toCube(), word);
    expectRefused(toGrid(), word);
    grid_ = good;
  };
  grid_.size = 8;
  refuse("size");
  grid_.width = 0;
  refuse("columns");
  grid_.height = 1;
  refuse("rows");
  grid_.width = (1 << 20) + 1;
  refuse("1048576");
  grid_.geotransform[1] = 5;
  refuse("round");
  grid_.geotransform[3] = 100;
  refuse("poles");
  grid_.geotransform[0] = std::numeric_limits<double>::quiet_NaN();
  refuse("finite");
}

TEST_F(Globe, RefusesWhatIsNoCube) {
  for (const uint32_t depth : {0u, TKS_MOST_CUBE_DEPTH + 1u, UINT32_MAX}) {
    expectRefused(toCube(depth), "depth");
    expectRefused(toGrid(nullptr, depth), "depth");
  }
}

TEST_F(Globe, RefusesHeightsThatAreNone) {
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), HUGE_VALF, -2e30f}) {
    const float before = std::exchange(heights_[100], value);
    expectRefused(toCube(), "voids");
    heights_[100] = before;
  }
}

TEST_F(Globe, RefusesOtherWindows) {
  for (const tks_window& window :
       {tks_window{0, 0, 0, 1}, tks_window{0, 0, 1, 0}, tks_window{64, 0, 1, 1},
        tks_window{0, 32, 1, 1}, tks_window{63, 0, 65, 1}, tks_window{1, 1, UINT32_MAX, 1}})
    expectRefused(toGrid(&window), "window");
}

TEST_F(Globe, RefusesWhatIsMissing) {
  EXPECT_EQ(tks_grid_from_cube(nullptr, kDepth, &grid_, nullptr, 1, back_.data(), nullptr, 0),
            TKS_USAGE);
  EXPECT_EQ(tks_grid_from_cube(cube_.data(), kDepth, nullptr, nullptr, 1, back_.data(), nullptr, 0),
            TKS_USAGE);
  EXPECT_EQ(tks_grid_from_cube(cube_.data(), kDepth, &grid_, nullptr, 1, nullptr, nullptr, 0),
            TKS_USAGE);
  EXPECT_EQ(
      tks_cube_from_grid(&grid_, nullptr, kDepth, 1, cube_.data(), nullptr, nullptr, nullptr, 0),
      TKS_USAGE);
  EXPECT_EQ(
      tks_cube_from_grid(&grid_, heights_.data(), kDepth, 1, nullptr, nullptr, nullptr, nullptr, 0),
      TKS_USAGE);
}

}  // namespace
}  // namespace tetrakis::test
