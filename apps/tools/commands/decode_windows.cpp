// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/decode_windows.hpp"

#include <string>

#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/place/texture_place.hpp"
#include "apps/tools/files/stream.hpp"

namespace tetrakis::tools {

namespace {

/// Whether columns go on behind the last one with the first.
bool goesRound(const tks_info& info) {
  const tks_domain domain = info.has_heights ? info.domain : info.texture_domain;
  return domain == TKS_DOMAIN_CYLINDER || (info.has_heights && isGridOnCube(info));
}

std::optional<tks_window> texelsOver(const tks_window& samples, const tks_info& info) {
  return TexturePlace(PlacedRaster::heightsOf(info), PlacedRaster::textureOf(info))
      .texelsOver(samples);
}

}  // namespace

std::optional<tks_window> heightWindow(const DecodeArguments& arguments) {
  const std::vector<uint32_t>& w = arguments.window;
  if (w.empty()) return std::nullopt;
  return tks_window{w[0], w[1], w[2], w[3]};
}

std::optional<tks_window> textureWindow(const DecodeArguments& arguments, const tks_info& info) {
  const std::optional<tks_window> samples = heightWindow(arguments);
  if (!samples || !info.has_heights || !info.has_texture) return samples;
  return texelsOver(*samples, info);
}

Status checkWindow(const DecodeArguments& arguments, const tks_info& info) {
  const std::optional<tks_window> w = heightWindow(arguments);
  if (!w) return Status();
  const Extent heights = shownHeights(info);
  const uint64_t width = info.has_heights ? heights.width : info.texture_width;
  const uint64_t height = info.has_heights ? heights.height : info.texture_height;
  const uint64_t columns = goesRound(info) && w->x < width ? width + w->x : width;
  if (w->width > 0 && w->height > 0 && uint64_t{w->x} + w->width <= columns &&
      uint64_t{w->y} + w->height <= height) {
    const bool both = wantsTexture(arguments) && info.has_heights && info.has_texture;
    if (!both || texelsOver(*w, info)) return Status();
    return Status(TKS_USAGE, "the texture of this stream lies beside the ground of --window");
  }
  return Status(TKS_USAGE, "--window must lie inside the " + std::to_string(width) + " x " +
                               std::to_string(height) + " samples");
}

}  // namespace tetrakis::tools
