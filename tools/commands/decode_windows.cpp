// SPDX-License-Identifier: Apache-2.0
#include "tools/commands/decode_windows.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace tetrakis::tools {

namespace {

/// The image covers the ground from the first sample to the last.
tks_window texelsOver(const tks_window& samples, const tks_info& info) {
  const auto side = [](uint64_t first, uint64_t count, uint64_t all, uint64_t texels) {
    const uint64_t begin = std::min(first * texels / (all - 1), texels - 1);
    const uint64_t end = ((first + count - 1) * texels + all - 2) / (all - 1);
    return std::pair(static_cast<uint32_t>(begin),
                     static_cast<uint32_t>(std::clamp(end, begin + 1, texels) - begin));
  };
  const auto [x, width] = side(samples.x, samples.width, info.width, info.texture_width);
  const auto [y, height] = side(samples.y, samples.height, info.height, info.texture_height);
  return {x, y, width, height};
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
  const uint64_t width = info.has_heights ? info.width : info.texture_width;
  const uint64_t height = info.has_heights ? info.height : info.texture_height;
  if (w->width > 0 && w->height > 0 && uint64_t{w->x} + w->width <= width &&
      uint64_t{w->y} + w->height <= height) {
    return Status();
  }
  return Status(TKS_USAGE, "--window must lie inside the " + std::to_string(width) + " x " +
                               std::to_string(height) + " samples");
}

}  // namespace tetrakis::tools
