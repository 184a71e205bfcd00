// SPDX-License-Identifier: Apache-2.0
#include "api/texture_strips.hpp"

#include <algorithm>

namespace tetrakis::inline api {

namespace {

/// Filters reach some rows into the strips beside them: in a smaller one these would count.
constexpr uint32_t kTexels = 1 << 20, kLeastRows = 64;

/// Whether one strip leaves to the next what it decoded.
bool areRemembered(const tks_decoder& decoder) {
  const TextureHeader& header = *decoder.parsed.header.texture;
  if (!decoder.remembers || header.direct()) return false;
  const auto& tracks = decoder.packets.payload.codewords[static_cast<size_t>(Component::kTexture)];
  const auto first = tracks.find(0);
  const uint64_t opening = header.alpha_bytes + header.overlay_bytes;
  return opening == 0 || (first != tracks.end() && first->second.size() >= opening);
}

}  // namespace

std::vector<View> textureStrips(const tks_decoder& decoder, const View& view) {
  const TextureHeader& header = *decoder.parsed.header.texture;
  const uint32_t rows = std::max(kTexels / header.width, kLeastRows);
  const bool strips =
      view.isWhole() && rows < header.height && header.repeats.none() && areRemembered(decoder);
  if (!strips) return {view};
  std::vector<View> views;
  for (uint32_t y = 0; y < header.height; y += rows)
    views.push_back({0, Window{0, y, header.width, std::min(rows, header.height - y)}});
  return views;
}

}  // namespace tetrakis::inline api
