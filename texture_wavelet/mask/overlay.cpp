// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/mask/overlay.hpp"

#include <cstddef>
#include <optional>
#include <unordered_map>

namespace tetrakis::inline mask {

namespace {

constexpr size_t kLeastShare = 2000;  // a colour of fewer than 1/2000 of the texels is no overlay's
constexpr size_t kLeastAlike = 500;   // where fewer than 1/500 of them are alike there is none

/// A colour in one number; nothing for one that does not matter.
using Colour = std::optional<uint64_t>;

Colour colourAt(const Texels& texels, Mask seen, size_t texel) {
  if (!seen[texel]) return {};
  uint64_t colour = 0;
  for (size_t c = 0; c < texels.channels; ++c)
    colour = colour << 16 | texels.samples[texel * texels.channels + c];
  return colour;
}

/// How many texels have a colour, how many of them are like the one before in the row, and how many
/// like that or the one above.
struct Use {
  size_t texels = 0, in_row = 0, alike = 0;

  /// Lines of one texel are alike along one side of the image alone, but nearly all of them. In
  /// images of few colours half of the texels are that by chance.
  bool isDrawn(size_t count) const {
    const bool large = texels * kLeastShare >= count;
    return large && (2 * in_row >= texels || 4 * alike >= 3 * texels);
  }
};

/// How often each colour is used that occurs twice in a row, or in a column: lines are thin in one
/// of them. Photographs have next to none.
std::unordered_map<uint64_t, Use> repeatedColours(const Texels& texels, Mask seen) {
  std::unordered_map<uint64_t, Use> uses;
  const size_t count = size_t{texels.width} * texels.height;
  std::vector<Colour> row_before(texels.width);
  Colour before;
  for (size_t i = 0; i < count; ++i) {
    const Colour colour = colourAt(texels, seen, i);
    Colour& above = row_before[i % texels.width];
    if (colour && (colour == before || colour == above)) {
      Use& use = uses[*colour];
      ++use.alike;
      use.in_row += colour == before;
    }
    before = above = colour;
  }
  return uses;
}

}  // namespace

std::vector<uint8_t> photographOf(const Texels& texels, Mask seen) {
  const size_t count = size_t{texels.width} * texels.height;
  std::unordered_map<uint64_t, Use> uses = repeatedColours(texels, seen);
  size_t alike = 0;
  std::erase_if(uses, [&](const auto& use) { return 2 * use.second.alike * kLeastShare < count; });
  for (const auto& [colour, use] : uses) alike += use.alike;
  if (alike * kLeastAlike < count) return {};
  const auto useAt = [&](size_t texel) {
    const Colour colour = colourAt(texels, seen, texel);
    return colour ? uses.find(*colour) : uses.end();
  };
  for (size_t i = 0; i < count; ++i) {
    const auto use = useAt(i);
    if (use != uses.end()) ++use->second.texels;
  }
  std::vector<uint8_t> photograph(count);
  size_t drawn = 0, left = 0;
  for (size_t i = 0; i < count; ++i) {
    const auto use = useAt(i);
    photograph[i] = use == uses.end() || !use->second.isDrawn(count);
    drawn += photograph[i] == 0;
    left += photograph[i] != 0 && seen[i];
  }
  if (drawn == 0 || left == 0) return {};
  return photograph;
}

}  // namespace tetrakis::inline mask
