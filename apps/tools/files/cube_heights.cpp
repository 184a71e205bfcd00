// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/files/cube_heights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "apps/tools/files/place/ground_spacing.hpp"

namespace tetrakis::tools {

namespace {

/// Of the Earth's meridians, from a pole to the equator.
constexpr double kQuarterMeridian = 10'002'000;

Status refused(const char* message) {
  return {TKS_USAGE, std::string("--domain cube: ") + message};
}

/// Voids are NaN.
std::vector<float> heightsOf(const HeightFile& file) {
  std::vector<float> heights(size_t{file.width} * file.height);
  withSampleType(file.sample, [&](auto type) {
    for (size_t i = 0; i < heights.size(); ++i) {
      std::memcpy(&type, file.data.data() + i * sizeof type, sizeof type);
      const auto sample = static_cast<double>(type);
      heights[i] = file.nodata && sample == *file.nodata
                       ? std::numeric_limits<float>::quiet_NaN()
                       : static_cast<float>(sample * file.scale + file.offset);
    }
  });
  return heights;
}

/// To the nearest samples of the type.
std::vector<std::byte> samplesOf(std::span<const float> heights, tks_sample sample, double scale,
                                 double offset) {
  std::vector<std::byte> data(heights.size() * tks_sample_bytes(sample));
  withSampleType(sample, [&](auto type) {
    using T = decltype(type);
    for (size_t i = 0; i < heights.size(); ++i) {
      double value = (heights[i] - offset) / scale;
      if constexpr (std::numeric_limits<T>::is_integer)
        value = std::clamp<double>(std::nearbyint(value), std::numeric_limits<T>::min(),
                                   std::numeric_limits<T>::max());
      const T stored = static_cast<T>(value);
      std::memcpy(data.data() + i * sizeof stored, &stored, sizeof stored);
    }
  });
  return data;
}

Result<tks_geographic_grid> gridOf(uint32_t width, uint32_t height, const GeoTransform& transform,
                                   const std::string& geo_keys, const std::string& crs) {
  const double degrees = gridUnitOf(geo_keys, crs).degrees;
  if (degrees == 0) return refused("the coordinates of the heights are no angles");
  tks_geographic_grid grid = {sizeof grid, width, height, {}};
  std::transform(transform.begin(), transform.end(), grid.geotransform,
                 [&](double coordinate) { return coordinate * degrees; });
  return grid;
}

Result<tks_geographic_grid> gridOf(const tks_info& info) {
  return gridOf(info.grid_width, info.grid_height, std::to_array(info.geotransform), info.geo_keys,
                info.crs);
}

Result<std::vector<float>> resampled(const HeightFile& file, uint32_t depth, uint32_t threads,
                                     CubeErrors& errors) {
  if (!file.geotransform) return refused("nothing tells where the heights lie");
  const auto grid = gridOf(file.width, file.height, *file.geotransform, file.geo_keys, file.crs);
  if (!grid.ok()) return grid.status();
  const size_t side = (size_t{1} << std::min(depth, 31u)) + 1;
  std::vector<float> cube(depth > TKS_MOST_CUBE_DEPTH ? 1 : kCubePatches * side * side);
  std::array<char, 256> message{};
  const tks_status status =
      tks_cube_from_grid(&*grid, heightsOf(file).data(), depth, threads, cube.data(),
                         &errors.largest, &errors.rmse, message.data(), message.size());
  if (status == TKS_USAGE) return refused(message.data());
  if (status != TKS_OK) return Status(status, message.data());
  return cube;
}

}  // namespace

Result<HeightFile> onCube(const HeightFile& grid, uint32_t depth, uint32_t threads,
                          CubeErrors& errors) {
  if (depth == 0) depth = tks_cube_depth(grid.width);
  const Result<std::vector<float>> cube = resampled(grid, depth, threads, errors);
  if (!cube.ok()) return cube.status();
  HeightFile file = grid;
  file.cube_depth = depth;
  file.grid_width = grid.width;
  file.grid_height = grid.height;
  file.width = (uint32_t{1} << depth) + 1;
  file.height = kCubePatches * file.width;
  file.data = samplesOf(*cube, grid.sample, grid.scale, grid.offset);
  file.nodata.reset();
  file.spacing_x = file.spacing_y = kQuarterMeridian / (file.width - 1);
  return file;
}

bool isGridOnCube(const tks_info& info) {
  return info.domain == TKS_DOMAIN_FOREST && info.grid_width > 0 && info.has_geotransform != 0 &&
         info.forest.patches == kCubePatches && info.forest.depth <= TKS_MOST_CUBE_DEPTH &&
         std::equal(info.forest.sides, info.forest.sides + 4 * kCubePatches, tks_cube_sides());
}

Result<std::vector<float>> gridOfCube(const tks_info& info, std::span<const float> surface) {
  const Result<tks_geographic_grid> grid = gridOf(info);
  if (!grid.ok()) return grid.status();
  std::vector<float> heights(size_t{grid->width} * grid->height);
  std::array<char, 256> message{};
  const tks_status status = tks_grid_from_cube(surface.data(), info.forest.depth, &*grid, nullptr,
                                               1, heights.data(), message.data(), message.size());
  if (status != TKS_OK) return Status(status, message.data());
  return heights;
}

Result<std::vector<float>> gridOfCube(Decoder& decoder, const tks_window& window) {
  const Result<tks_geographic_grid> grid = gridOf(decoder.info());
  if (!grid.ok()) return grid.status();
  return decoder.grid(*grid, window);
}

std::vector<std::byte> samplesOfGrid(const tks_info& info, std::span<const float> heights) {
  return samplesOf(heights, info.sample, info.scale, info.offset);
}

}  // namespace tetrakis::tools
