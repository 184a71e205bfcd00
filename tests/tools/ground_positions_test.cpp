// SPDX-License-Identifier: Apache-2.0
// Longitudes and latitudes of national grids, in few bytes: held against PROJ all over rasters of
// small and large extents, over poles and 180 degrees.
#include <gtest/gtest.h>
#include <proj.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "apps/tools/files/place/ground_positions.hpp"
#include "apps/tools/files/place/proj_objects.hpp"
#include "bitstream/stream/georeference.hpp"

namespace tetrakis::tools {
namespace {

constexpr uint64_t kAnyBytes = 1 << 20;

struct Grid {
  const char* crs;
  double x, y, sample;  ///< of the north-western corner, in units of the CRS
  uint32_t width, height;
};

HeightFile heightsOn(const Grid& grid) {
  HeightFile heights;
  heights.width = grid.width;
  heights.height = grid.height;
  heights.crs = grid.crs;
  heights.geotransform = GeoTransform{grid.x, grid.sample, 0, grid.y, 0, -grid.sample};
  return heights;
}

LongitudeLatitude placeIn(const std::vector<uint8_t>& bytes, double u, double v) {
  const auto positions = groundPositionsIn(std::string(bytes.begin(), bytes.end()));
  EXPECT_TRUE(positions);
  const TangentPlane plane({double(positions->longitude), double(positions->latitude)});
  return plane.unproject(positions->at(u, v));
}

class Proj {
 public:
  /// By the operation that suits the middle best, as for the positions.
  explicit Proj(const Grid& grid) {
    const ProjObject raw(proj_create_crs_to_crs(context_.get(), grid.crs, "EPSG:4326", nullptr));
    to_degrees_.reset(proj_normalize_for_visualization(context_.get(), raw.get()));
    proj_trans(to_degrees_.get(), PJ_FWD,
               proj_coord(grid.x + grid.sample * grid.width / 2,
                          grid.y - grid.sample * grid.height / 2, 0, HUGE_VAL));
    to_degrees_.reset(proj_trans_get_last_used_operation(to_degrees_.get()));
  }
  /// How far a place is off from a column and a row, in samples.
  double error(const Grid& grid, const LongitudeLatitude& place, double column, double row) const {
    const PJ_COORD back = proj_trans(to_degrees_.get(), PJ_INV,
                                     proj_coord(place.longitude, place.latitude, 0, HUGE_VAL));
    return std::hypot(back.xy.x - (grid.x + column * grid.sample),
                      back.xy.y - (grid.y - row * grid.sample)) /
           grid.sample;
  }

 private:
  ProjContext context_ = quietContext();
  ProjObject to_degrees_;
};

double worstError(const Grid& grid, const std::vector<uint8_t>& bytes) {
  const Proj proj(grid);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> any(-1, 1);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const bool at_edge = i < 400;
    double u = any(random), v = any(random);
    if (at_edge) (i % 2 ? u : v) = i % 4 < 2 ? -1 : 1;
    const double column = (u + 1) / 2 * grid.width, row = (v + 1) / 2 * grid.height;
    worst = std::max(worst, proj.error(grid, placeIn(bytes, u, v), column, row));
  }
  return worst;
}

const Grid kNational[] = {
    {"EPSG:2056", 2600000, 1200000, 0.5, 2000, 2000},
    {"EPSG:2056", 2480000, 1300000, 10, 36000, 23000},
    {"EPSG:21781", 480000, 300000, 25, 14000, 9000},
    {"EPSG:27700", 400000, 300000, 1, 1000, 1000},
    {"EPSG:27700", 0, 1300000, 50, 14000, 26000},
    {"EPSG:3035", 4300000, 3200000, 25, 4000, 4000},
    {"EPSG:3035", 2500000, 5500000, 100, 50000, 41000},
    {"EPSG:3035", 4321000, 3210000, 1e-2, 500, 400},
    {"EPSG:5514", -904000, -935000, 10, 47000, 29000},
    {"EPSG:5514", -700000, -1100000, 2, 1025, 513},
    {"EPSG:3031", -3333000, 3333000, 500, 13332, 13332},
    {"EPSG:3031", -500000, 500000, 10, 4097, 2049},
    {"EPSG:3413", -800000, -600000, 150, 10000, 18000},
    {"EPSG:2193", 1000000, 6300000, 15, 72000, 100000},
    {"EPSG:2193", 1570000, 5200000, 1, 480, 720},
    {"EPSG:28992", 0, 630000, 5, 56000, 66000},
    {"EPSG:31370", 20000, 250000, 1, 4000, 2500},
    {"EPSG:2154", 100000, 7150000, 25, 46000, 44000},
    {"EPSG:5070", -2356000, 3172000, 100, 46000, 29000},
    {"EPSG:3577", -1900000, -1050000, 100, 41000, 38000},
    {"EPSG:4289", 3.2, 53.7, 0.0005, 8000, 6000},
    {"EPSG:3832", 2000000, 100000, 90, 12000, 9000},
    {"EPSG:2263", 900000, 280000, 2, 80000, 80000},
    {"ESRI:102001", -2400000, 2000000, 1000, 5400, 2900},
    {"EPSG:3034", 3000000, 3000000, 30, 1, 400},
};

TEST(GroundPositions, LieWithinATenthOfASampleInTwoHundredBytes) {
  for (const Grid& grid : kNational) {
    SCOPED_TRACE(std::string(grid.crs) + " by " + std::to_string(grid.sample));
    HeightFile heights = heightsOn(grid);
    ASSERT_EQ(addPositions(&heights, nullptr, kAnyBytes), "");
    ASSERT_FALSE(heights.positions.empty());
    EXPECT_LE(heights.positions.size(), 200u);
    EXPECT_LE(worstError(grid, heights.positions), 0.101);
  }
}

/// Longitudes do not jump.
TEST(GroundPositions, GoOnBehindTheDateLine) {
  const Grid pacific = {"EPSG:3832", 2500000, 100000, 1000, 3000, 2000};
  HeightFile heights = heightsOn(pacific);
  ASSERT_EQ(addPositions(&heights, nullptr, kAnyBytes), "");
  double last = placeIn(heights.positions, -1, 0).longitude, most = last;
  for (double u = -0.99; u <= 1; u += 0.01) {
    const double next = placeIn(heights.positions, u, 0).longitude;
    EXPECT_GT(next, last);
    EXPECT_LT(next - last, 1);
    most = std::max(most, last = next);
  }
  EXPECT_TRUE(most > 180 || placeIn(heights.positions, -1, 0).longitude < -180);
}

/// The south pole lies between samples, and every longitude around it.
TEST(GroundPositions, HoldAPole) {
  const Grid pole = {"EPSG:3031", -1000, 1000, 10, 200, 200};
  HeightFile heights = heightsOn(pole);
  ASSERT_EQ(addPositions(&heights, nullptr, kAnyBytes), "");
  EXPECT_NEAR(placeIn(heights.positions, 0, 0).latitude, -90, 1e-4);
  for (const auto& [u, v] : {std::pair(0.5, 0.5), {-0.5, 0.5}, {0.5, -0.5}, {-0.5, -0.5}}) {
    const LongitudeLatitude place = placeIn(heights.positions, u, v);
    const double away = std::remainder(place.longitude - std::atan2(u, -v) * 180 / M_PI, 360);
    EXPECT_NEAR(away, 0, 0.1);
  }
}

TEST(GroundPositions, AreNotKeptWhereTheyDoNotFit) {
  const Grid wide[] = {{"EPSG:8857", -17243959, 8392927, 1000, 34488, 16786},
                       {"ESRI:54009", -18000000, 9000000, 5000, 7200, 3600}};
  for (const Grid& grid : wide) {
    HeightFile heights = heightsOn(grid);
    const std::string remark = addPositions(&heights, nullptr, kAnyBytes);
    EXPECT_NE(remark.find("`project`"), remark.npos) << grid.crs;
    EXPECT_TRUE(heights.positions.empty()) << grid.crs;
  }
}

TEST(GroundPositions, AreLeftOutWhereBrowsersKnowTheSystemOrBytesAreFew) {
  for (const char* crs : {"EPSG:4326", "epsg:3857", "EPSG:32632", "EPSG:32760+5773", "EPSG:25832",
                          "EPSG:26911", "EPSG:4979", "ESRI:102100", "", "no system at all"}) {
    HeightFile heights = heightsOn({crs, 7, 46, 0.001, 300, 200});
    EXPECT_EQ(addPositions(&heights, nullptr, kAnyBytes), "") << crs;
    EXPECT_TRUE(heights.positions.empty()) << crs;
  }
  HeightFile heights = heightsOn(kNational[0]);
  EXPECT_EQ(addPositions(&heights, nullptr, 10), "");
  EXPECT_TRUE(heights.positions.empty());
}

ImageFile imageOn(const Grid& grid) {
  ImageFile image;
  image.width = grid.width;
  image.height = grid.height;
  image.place = heightsOn(grid);
  return image;
}

/// A texture on the heights has theirs, as exactly as its texels need.
TEST(GroundPositions, OfATextureAreThoseOfTheHeightsOrItsOwn) {
  const Grid coarse = {"EPSG:2056", 2600000, 1200000, 100, 500, 500};
  const Grid fine = {"EPSG:2056", 2600000, 1200000, 1, 32768, 32768};
  const Grid beside = {"EPSG:2056", 2700000, 1200000, 1, 500, 500};
  const Grid elsewhere = {"EPSG:3035", 4200000, 2700000, 1, 500, 500};
  HeightFile heights = heightsOn(coarse);
  ImageFile image = imageOn(fine);
  EXPECT_EQ(addPositions(&heights, &image, kAnyBytes), "");
  EXPECT_TRUE(image.place.positions.empty());
  EXPECT_LE(worstError(coarse, heights.positions), 0.00101);
  for (const Grid& grid : {beside, elsewhere}) {
    image = imageOn(grid);
    EXPECT_EQ(addPositions(&heights, &image, kAnyBytes), "");
    EXPECT_LE(worstError(grid, image.place.positions), 0.101);
  }
  image = imageOn(beside);
  EXPECT_EQ(addPositions(nullptr, &image, kAnyBytes), "");
  EXPECT_FALSE(image.place.positions.empty());
}

}  // namespace
}  // namespace tetrakis::tools
