// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/cube.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include <cpl_error.h>
#include "apps/doors/gdal/copied_raster.hpp"
#include "apps/doors/gdal/source.hpp"
#include "base/samples.hpp"

namespace tetrakis::gdal {
namespace {

constexpr uint32_t kPatches = 6;
/// Of the Earth's meridians, from a pole to the equator, in metres.
constexpr double kQuarterMeridian = 10'002'000;

bool refuse(const std::string& name, const std::string& sentence) {
  reportFailure(TKS_USAGE, name, "DOMAIN=CUBE: " + sentence);
  return false;
}

/// In their unit; voids are NaN.
std::vector<float> heightsOf(const CopiedHeights& copy) {
  const tks_heights& grid = copy.heights;
  std::vector<float> heights(size_t{grid.width} * grid.height);
  withSampleType(grid.sample, [&](auto type) {
    for (size_t i = 0; i < heights.size(); ++i) {
      std::memcpy(&type, copy.samples.data() + i * sizeof type, sizeof type);
      const auto sample = static_cast<double>(type);
      heights[i] = grid.has_nodata && sample == grid.nodata
                       ? std::numeric_limits<float>::quiet_NaN()
                       : static_cast<float>(sample * grid.scale + grid.offset);
    }
  });
  return heights;
}

/// The nearest samples of the type that the grid has.
std::vector<std::byte> samplesOf(const std::vector<float>& heights, const tks_heights& grid) {
  std::vector<std::byte> samples(heights.size() * tks_sample_bytes(grid.sample));
  withSampleType(grid.sample, [&](auto type) {
    using T = decltype(type);
    for (size_t i = 0; i < heights.size(); ++i) {
      double value = (heights[i] - grid.offset) / grid.scale;
      if constexpr (std::numeric_limits<T>::is_integer)
        value = std::clamp<double>(std::nearbyint(value), std::numeric_limits<T>::min(),
                                   std::numeric_limits<T>::max());
      const T sample = static_cast<T>(value);
      std::memcpy(samples.data() + i * sizeof sample, &sample, sizeof sample);
    }
  });
  return samples;
}

/// What the stream says of the cube. The georeference remains that of the grid.
void describeCube(uint32_t depth, tks_heights& heights) {
  const uint32_t side = (uint32_t{1} << depth) + 1;
  heights.grid_width = heights.width;
  heights.grid_height = heights.height;
  heights.width = side;
  heights.height = kPatches * side;
  heights.domain = TKS_DOMAIN_FOREST;
  heights.forest = {depth, kPatches, tks_cube_sides()};
  heights.spacing_x = heights.spacing_y = kQuarterMeridian / (side - 1);
  heights.has_nodata = 0;
  heights.first_latitude = heights.last_latitude = 0;
}

}  // namespace

bool isGridOnCube(const tks_info& info) {
  return info.domain == TKS_DOMAIN_FOREST && info.grid_width > 0 && info.has_geotransform != 0 &&
         info.forest.patches == kPatches && info.forest.depth <= TKS_MOST_CUBE_DEPTH &&
         std::equal(info.forest.sides, info.forest.sides + 4 * kPatches, tks_cube_sides());
}

bool resampleOnCube(const std::string& name, const CubeWanted& wanted, CopiedHeights& copy) {
  tks_heights& heights = copy.heights;
  if (!heights.has_geotransform) return refuse(name, "Nothing tells where the heights lie.");
  if (wanted.degrees == 0) return refuse(name, "The coordinates of the heights are no angles.");
  tks_geographic_grid grid = {sizeof grid, heights.width, heights.height, {}};
  std::transform(heights.geotransform, heights.geotransform + 6, grid.geotransform,
                 [&](double coordinate) { return coordinate * wanted.degrees; });
  const uint32_t depth = wanted.depth > 0 ? wanted.depth : tks_cube_depth(heights.width);
  const size_t side = (size_t{1} << depth) + 1;
  std::vector<float> cube(kPatches * side * side);
  double largest = 0, rmse = 0;
  std::array<char, 512> sentence{};
  const tks_status status =
      tks_cube_from_grid(&grid, heightsOf(copy).data(), depth, wanted.threads, cube.data(),
                         &largest, &rmse, sentence.data(), sentence.size());
  if (status == TKS_USAGE) return refuse(name, sentence.data());
  if (status != TKS_OK) {
    reportFailure(status, name, sentence.data());
    return false;
  }
  CPLDebug("TKS", "%s: a cube of depth %u gives the heights back within %.3g, with an RMSE of %.3g",
           name.c_str(), depth, largest, rmse);
  copy.samples = samplesOf(cube, heights);
  heights.data = copy.samples.data();
  describeCube(depth, heights);
  return true;
}

}  // namespace tetrakis::gdal
