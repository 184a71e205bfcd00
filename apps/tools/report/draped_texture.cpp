// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/draped_texture.hpp"

#include <algorithm>
#include <cmath>

#include "apps/tools/files/place/texture_place.hpp"

namespace tetrakis::tools {

void drapeTexture(const tks_info& info, std::span<const uint32_t> grid_indices, MeshFile& mesh) {
  if (!info.has_texture || !info.texture_has_geotransform) return;
  const TexturePlace place(PlacedRaster::heightsOf(info), PlacedRaster::textureOf(info));
  const auto part = [](double texel, uint32_t side) {
    return std::isfinite(texel) ? static_cast<float>(std::clamp(texel / side, 0., 1.)) : 0.f;
  };
  for (size_t i = 0; i < grid_indices.size(); ++i) {
    const auto [column, row] =
        place.texelAt(grid_indices[i] % info.width, grid_indices[i] / info.width);
    mesh.texcoords[2 * i] = part(column, info.texture_width);
    mesh.texcoords[2 * i + 1] = part(row, info.texture_height);
  }
}

}  // namespace tetrakis::tools
