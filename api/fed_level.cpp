// SPDX-License-Identifier: Apache-2.0
// How finely the bytes that are there tell of heights and texture.
#include <algorithm>
#include <span>
#include <vector>

#include "api/decoder.hpp"
#include "bitstream/track/regions.hpp"

namespace tetrakis::inline api {

namespace {

/// An eighth of a bit for each.
constexpr uint64_t kSamplesOfByte = 64;

/// The finest level from `first` on at which so many samples of level 0 share the bytes.
int levelFedBy(uint64_t bytes, uint64_t samples, int first) {
  int level = first;
  while (samples >> (2 * level) > kSamplesOfByte * bytes) ++level;
  return level;
}

int fedLevel(const tks_decoder& decoder, Component component, const auto& header) {
  if (isComplete(decoder)) return 0;
  int fed = coarsestLevel(header.shown());
  const auto regions = regionsOf(header.width, header.height, header.regions.side_log2);
  const auto& tracks = decoder.packets.payload.codewords[static_cast<size_t>(component)];
  for (const auto& [number, bytes] : tracks) {
    if (number >= regions.size() || bytes.empty()) continue;  // tracks of corrections
    const Region& region = regions[number];
    const uint64_t samples = uint64_t{region.x1 - region.x0} * (region.y1 - region.y0);
    fed = std::min(fed, levelFedBy(bytes.size(), samples, region.first_level - 1));
  }
  return fed;
}

Status giveFedLevel(const tks_decoder& decoder, tks_part part, uint32_t* level) {
  if (level == nullptr) return outputMissing();
  if (part != TKS_PART_HEIGHTS && part != TKS_PART_TEXTURE)
    return {TKS_USAGE, "Levels are fed of heights or of a texture."};
  if (const Result<View> view = viewOf(decoder, part, nullptr); !view.ok()) return view.status();
  const StreamHeader& header = decoder.parsed.header;
  *level = static_cast<uint32_t>(part == TKS_PART_TEXTURE
                                     ? fedLevel(decoder, Component::kTexture, *header.texture)
                                     : fedLevel(decoder, Component::kGeometry, *header.geometry));
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_fed_level(tks_decoder* decoder, tks_part part, uint32_t* level) {
  return tetrakis::keeping(decoder, [&] { return tetrakis::giveFedLevel(*decoder, part, level); });
}
