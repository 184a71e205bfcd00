// SPDX-License-Identifier: Apache-2.0
// Heights on a cube as samples of the grid that they were made of, or of a coarser one on the same
// ground. Of a cube in regions windows of its grid are interpolated on the parts that they need.
// Else a level of the cube is decoded as a whole and kept.
#include <algorithm>
#include <array>
#include <utility>

#include "apps/doors/gdal/source.hpp"
#include "base/coordinates.hpp"

namespace tetrakis::gdal {

bool Source::placeGrid(double degrees) {
  if (degrees == 0) {
    reportFailure(TKS_UNSUPPORTED, name_,
                  "The heights lie on a cube, and the coordinates of its grid are no angles.");
    return false;
  }
  degrees_ = degrees;
  const tks_geographic_grid grid = gridOf(info_);
  const bool repeats =
      columnsRound({grid.width, grid.height, grid.geotransform}, 1) == ColumnsRound::kRepeating;
  round_ = grid.width - repeats;
  // One sample of the least cube tells what there is to say of the grid.
  const std::array<float, 6 * 3 * 3> flat{};
  const tks_window first{0, 0, 1, 1};
  float sample = 0;
  std::array<char, 512> sentence{};
  const tks_status status = tks_grid_from_cube(flat.data(), 1, &grid, &first, 1, &sample,
                                               sentence.data(), sentence.size());
  if (status != TKS_OK) reportFailure(status, name_, sentence.data());
  return status == TKS_OK;
}

tks_geographic_grid Source::gridOf(const tks_info& info) const {
  tks_geographic_grid grid = {sizeof grid, info.grid_width, info.grid_height, {}};
  std::transform(info.geotransform, info.geotransform + 6, grid.geotransform,
                 [&](double coordinate) { return coordinate * degrees_; });
  return grid;
}

const Source::Cube* Source::cube(uint32_t level) {
  Cube& kept = cubes_[level];
  if (!kept.surface.empty()) return &kept;
  if (!load(level, nullptr)) return nullptr;
  tks_decoder* const decoder = decoder_.get();
  tks_info info{};
  info.size = sizeof info;
  tks_status status = tks_set_levels(decoder, level, 0);
  if (status == TKS_OK) status = tks_get_info(decoder, &info);
  const uint64_t samples = uint64_t{info.width} * info.height;
  if (status == TKS_OK) {
    const uint64_t beside = samples * sizeof(float);
    status = tks_check_memory(decoder, TKS_PART_HEIGHTS, nullptr, 0, beside, nullptr);
  }
  std::vector<float> surface(status == TKS_OK ? samples : 0);
  if (status == TKS_OK) status = tks_decode_surface(decoder, surface.data(), surface.size());
  if (status != TKS_OK) {
    failed(status);
    return nullptr;
  }
  kept = {std::move(surface), info.forest.depth, gridOf(info)};
  return &kept;
}

bool Source::gridOfLevel(uint32_t level, const tks_window& window, std::span<float> heights) {
  const Cube* const cube = this->cube(level);
  if (cube == nullptr) return false;
  std::array<char, 512> sentence{};
  const tks_status status =
      tks_grid_from_cube(cube->surface.data(), cube->depth, &cube->grid, &window, settings_.threads,
                         heights.data(), sentence.data(), sentence.size());
  if (status != TKS_OK) reportFailure(status, name_, sentence.data());
  return status == TKS_OK;
}

bool Source::gridOfRegions(uint32_t level, const tks_window& window, std::span<float> heights) {
  if (!decoder_ && !reopen(std::min(end_, info_.header_bytes))) return false;
  tks_info info{};
  info.size = sizeof info;
  tks_status status = tks_set_levels(decoder_.get(), level, 0);
  if (status == TKS_OK) status = tks_get_info(decoder_.get(), &info);
  if (status != TKS_OK) return failed(status);
  const tks_geographic_grid grid = gridOf(info);
  std::array<tks_window, 6> parts{};
  std::array<char, 512> sentence{};
  status = tks_cube_windows(info.forest.depth, &grid, &window, parts.data(), sentence.data(),
                            sentence.size());
  if (status != TKS_OK) {
    reportFailure(status, name_, sentence.data());
    return false;
  }
  for (const tks_window& part : parts)
    if (part.width > 0 && !load(level, &part)) return false;
  status = tks_set_levels(decoder_.get(), level, 0);
  if (status == TKS_OK)
    status = tks_decode_grid(decoder_.get(), &grid, &window, heights.data(), heights.size());
  return status == TKS_OK || failed(status);
}

bool Source::gridWindow(uint32_t level, const tks_window& window, std::vector<std::byte>& out) {
  const size_t samples = size_t{window.width} * window.height;
  out.resize(samples * sizeof(float));
  auto* const heights = reinterpret_cast<float*>(out.data());
  const bool regions = info_.regions > 0;
  if (!(regions ? gridOfRegions(level, window, {heights, samples})
                : gridOfLevel(level, window, {heights, samples})))
    return false;
  // The band has the scale and the offset of the stream.
  if (info_.scale != 1 || info_.offset != 0) {
    std::transform(heights, heights + samples, heights, [this](float height) {
      return static_cast<float>((height - info_.offset) / info_.scale);
    });
  }
  return true;
}

}  // namespace tetrakis::gdal
