// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/overlay.hpp"

#include <cstddef>
#include <unordered_map>

namespace tetrakis {

namespace {

constexpr size_t kLeastShare = 2000;  // a colour of fewer than 1/2000 of the texels is no overlay's
constexpr size_t kLeastAlike = 500;   // where fewer than 1/500 of them are alike there is none

/// All channels of a texel in one number.
uint64_t colourAt(const Texels& texels, size_t texel) {
  uint64_t colour = 0;
  for (size_t c = 0; c < texels.channels; ++c)
    colour = colour << 16 | texels.samples[texel * texels.channels + c];
  return colour;
}

struct Use {
  size_t texels = 0, alike = 0;
};

/// Of the colours that occur twice in a row. Photographs have next to none of them.
std::unordered_map<uint64_t, Use> repeatedColours(const Texels& texels) {
  std::unordered_map<uint64_t, Use> uses;
  const size_t count = size_t{texels.width} * texels.height;
  uint64_t before = colourAt(texels, 0);
  for (size_t i = 1; i < count; ++i) {
    const uint64_t colour = colourAt(texels, i);
    if (colour == before) ++uses[colour].alike;
    before = colour;
  }
  return uses;
}

}  // namespace

std::vector<uint8_t> photographOf(const Texels& texels) {
  const size_t count = size_t{texels.width} * texels.height;
  std::unordered_map<uint64_t, Use> uses = repeatedColours(texels);
  size_t alike = 0;
  std::erase_if(uses, [&](const auto& use) { return 2 * use.second.alike * kLeastShare < count; });
  for (const auto& [colour, use] : uses) alike += use.alike;
  if (alike * kLeastAlike < count) return {};
  for (size_t i = 0; i < count; ++i) {
    const auto use = uses.find(colourAt(texels, i));
    if (use != uses.end()) ++use->second.texels;
  }
  std::vector<uint8_t> photograph(count);
  size_t left = 0;
  for (size_t i = 0; i < count; ++i) {
    const auto use = uses.find(colourAt(texels, i));
    photograph[i] = use == uses.end() || 2 * use->second.alike < use->second.texels ||
                    use->second.texels * kLeastShare < count;
    left += photograph[i];
  }
  if (left == 0 || left == count) return {};
  return photograph;
}

}  // namespace tetrakis
