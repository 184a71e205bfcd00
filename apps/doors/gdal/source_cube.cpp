// SPDX-License-Identifier: Apache-2.0
// Heights on a cube as samples of the grid that they were made of. The cube is decoded as a whole
// and kept; windows of the grid are interpolated on it.
#include <algorithm>
#include <array>
#include <utility>

#include "apps/doors/gdal/source.hpp"

namespace tetrakis::gdal {

bool Source::placeGrid(double degrees) {
  if (degrees == 0) {
    reportFailure(TKS_UNSUPPORTED, name_,
                  "The heights lie on a cube, and the coordinates of its grid are no angles.");
    return false;
  }
  grid_ = {sizeof grid_, info_.grid_width, info_.grid_height, {}};
  std::transform(info_.geotransform, info_.geotransform + 6, grid_.geotransform,
                 [&](double coordinate) { return coordinate * degrees; });
  // One sample of the least cube tells what there is to say of the grid.
  const std::array<float, 6 * 3 * 3> flat{};
  const tks_window first{0, 0, 1, 1};
  float sample = 0;
  std::array<char, 512> sentence{};
  const tks_status status = tks_grid_from_cube(flat.data(), 1, &grid_, &first, 1, &sample,
                                               sentence.data(), sentence.size());
  if (status != TKS_OK) reportFailure(status, name_, sentence.data());
  return status == TKS_OK;
}

bool Source::decodeCube() {
  if (!cube_.empty()) return true;
  if (!load(0, nullptr)) return false;
  tks_decoder* const decoder = decoder_.get();
  const uint64_t samples = uint64_t{info_.width} * info_.height;
  tks_status status = tks_set_levels(decoder, 0, 0);
  if (status == TKS_OK) {
    const uint64_t beside = samples * sizeof(float);
    status = tks_check_memory(decoder, TKS_PART_HEIGHTS, nullptr, 0, beside, nullptr);
  }
  if (status != TKS_OK) return failed(status);
  std::vector<float> cube(samples);
  status = tks_decode_surface(decoder, cube.data(), cube.size());
  if (status != TKS_OK) return failed(status);
  cube_ = std::move(cube);
  return true;
}

bool Source::gridWindow(const tks_window& window, std::vector<std::byte>& out) {
  if (!decodeCube()) return false;
  const size_t samples = size_t{window.width} * window.height;
  out.resize(samples * sizeof(float));
  auto* const heights = reinterpret_cast<float*>(out.data());
  std::array<char, 512> sentence{};
  const tks_status status =
      tks_grid_from_cube(cube_.data(), cube_depth_, &grid_, &window, settings_.threads, heights,
                         sentence.data(), sentence.size());
  if (status != TKS_OK) {
    reportFailure(status, name_, sentence.data());
    return false;
  }
  // The band has the scale and the offset of the stream.
  if (info_.scale != 1 || info_.offset != 0) {
    std::transform(heights, heights + samples, heights, [this](float height) {
      return static_cast<float>((height - info_.offset) / info_.scale);
    });
  }
  return true;
}

}  // namespace tetrakis::gdal
