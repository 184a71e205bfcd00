// SPDX-License-Identifier: Apache-2.0
#include "tools/report/draped_texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

namespace tetrakis::tools {
namespace {

/// From samples of the heights to parts of the texture.
struct TextureMap {
  std::array<double, 3> u, v;  ///< at sample (0, 0), and what a column and a row add

  static float at(const std::array<double, 3>& map, double column, double row) {
    return static_cast<float>(std::clamp(map[0] + map[1] * column + map[2] * row, 0.0, 1.0));
  }
};

std::optional<TextureMap> mapOf(const tks_info& info) {
  const std::string_view own = info.texture_crs, heights = info.crs;
  if (!info.has_geotransform || !info.texture_has_geotransform || (!own.empty() && own != heights))
    return std::nullopt;
  const auto& from = info.geotransform;
  const auto& to = info.texture_geotransform;
  const double determinant = to[1] * to[5] - to[2] * to[4];
  if (!std::isnormal(determinant)) return std::nullopt;
  // A geotransform is that of corners of pixels; samples lie in their middles.
  const std::array<double, 3> east = {from[0] + (from[1] + from[2]) / 2 - to[0], from[1], from[2]};
  const std::array<double, 3> north = {from[3] + (from[4] + from[5]) / 2 - to[3], from[4], from[5]};
  TextureMap map;
  for (size_t i = 0; i < 3; ++i) {
    map.u[i] = (to[5] * east[i] - to[2] * north[i]) / determinant / info.texture_width;
    map.v[i] = (to[1] * north[i] - to[4] * east[i]) / determinant / info.texture_height;
    if (!std::isfinite(map.u[i]) || !std::isfinite(map.v[i])) return std::nullopt;
  }
  return map;
}

}  // namespace

void drapeTexture(const tks_info& info, std::span<const uint32_t> grid_indices, MeshFile& mesh) {
  const std::optional<TextureMap> map = info.has_texture ? mapOf(info) : std::nullopt;
  if (!map) return;
  for (size_t i = 0; i < grid_indices.size(); ++i) {
    const double column = grid_indices[i] % info.width, row = grid_indices[i] / info.width;
    mesh.texcoords[2 * i] = TextureMap::at(map->u, column, row);
    mesh.texcoords[2 * i + 1] = TextureMap::at(map->v, column, row);
  }
}

}  // namespace tetrakis::tools
