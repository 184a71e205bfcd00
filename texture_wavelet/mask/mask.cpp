// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/mask/mask.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <span>
#include <unordered_map>

namespace tetrakis::inline mask {

std::vector<uint8_t> cutoutOf(const Texels& texels) {
  std::vector<uint8_t> seen;
  if (!texels.hasAlpha()) return seen;
  const size_t count = size_t{texels.width} * texels.height;
  size_t opaque = 0;
  seen.resize(count);
  for (size_t i = 0; i < count; ++i) {
    const uint16_t alpha = texels.samples[(i + 1) * texels.channels - 1];
    if (alpha != 0 && alpha != texels.most()) return {};
    seen[i] = alpha != 0;
    opaque += seen[i];
  }
  if (opaque == count) return {};
  return seen;
}

std::vector<uint8_t> softlySeen(const Texels& texels) {
  if (!texels.hasAlpha()) return {};
  std::vector<uint8_t> seen(texels.extent().samples());
  bool soft = false;
  for (size_t i = 0; i < seen.size(); ++i) {
    const uint16_t alpha = texels.samples[(i + 1) * texels.channels - 1];
    seen[i] = alpha != 0;
    soft = soft || (alpha != 0 && alpha != texels.most());
  }
  if (!soft || std::find(seen.begin(), seen.end(), 0) == seen.end()) return {};
  return seen;
}

std::vector<std::vector<int32_t>> withMeanColour(Mask mask,
                                                 std::vector<std::vector<int32_t>> channels) {
  if (mask.all()) return channels;
  const std::span<const uint8_t> coded = mask.bytes();
  const auto count = std::max(int64_t{1}, std::accumulate(coded.begin(), coded.end(), int64_t{0}));
  for (std::vector<int32_t>& channel : channels) {
    int64_t sum = 0;
    for (size_t i = 0; i < coded.size(); ++i) sum += coded[i] * channel[i];
    const auto mean = static_cast<int32_t>((sum + count / 2) / count);
    for (size_t i = 0; i < coded.size(); ++i) {
      if (!coded[i]) channel[i] = mean;
    }
  }
  return channels;
}

uint64_t countedSamples(const Texels& texels, Mask seen) {
  if (seen.all()) return texels.samples.size();
  const std::span<const uint8_t> marks = seen.bytes();
  const auto opaque = std::accumulate(marks.begin(), marks.end(), uint64_t{0});
  return marks.size() + opaque * (texels.channels - 1);
}

double countedSquares(const Texels& original, const Texels& decoded, Mask seen) {
  uint64_t squares = 0;
  const auto add = [&](size_t k) {
    const int32_t difference = int32_t{original.samples[k]} - decoded.samples[k];
    squares += static_cast<uint32_t>(difference) * static_cast<uint32_t>(difference);
  };
  const size_t channels = original.channels;
  if (seen.all()) {
    for (size_t k = 0; k < original.samples.size(); ++k) add(k);
    return static_cast<double>(squares);
  }
  for (size_t i = 0; i < seen.bytes().size(); ++i) {
    for (size_t c = seen[i] ? 0 : channels - 1; c < channels; ++c) add(i * channels + c);
  }
  return static_cast<double>(squares);
}

namespace {

/// The part of the texels that a colour of an overlay has at least. A larger number finds smaller
/// lettering, and colours of photographs that are alike by chance.
constexpr size_t kLeastShare = 2000;
/// The part of the texels that have to be like a neighbour for an overlay to be looked for. A
/// larger number takes the time of more trials, and finds thinner overlays.
constexpr size_t kLeastAlike = 500;
/// One of this number of a drawn colour's texels is like the one before in its row, or this many
/// quarters of them are like a neighbour. A larger first number, or fewer quarters, finds more
/// lines, and takes textures of few colours for drawings.
constexpr size_t kInRowPart = 2, kAlikeQuarters = 3;

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
    return large && (kInRowPart * in_row >= texels || 4 * alike >= kAlikeQuarters * texels);
  }
};

using Uses = std::unordered_map<uint64_t, Use>;

/// How often each colour is used that occurs twice in a row, or in a column: lines are thin in one
/// of them. Photographs have next to none.
Uses repeatedColours(const Texels& texels, Mask seen) {
  Uses uses;
  std::vector<Colour> row_before(texels.width);
  Colour before;
  Use* use = nullptr;  // of `before`, once it is known
  for (size_t y = 0, i = 0; y < texels.height; ++y) {
    for (uint32_t x = 0; x < texels.width; ++x, ++i) {
      const Colour colour = colourAt(texels, seen, i);
      Colour& above = row_before[x];
      const bool in_row = colour == before;
      if (!in_row) use = nullptr;
      if (colour && (in_row || colour == above)) {
        if (use == nullptr) use = &uses[*colour];
        ++use->alike;
        use->in_row += in_row;
      }
      before = above = colour;
    }
  }
  return uses;
}

/// Looks up the uses of texels. Colours come in runs.
class UsesOfTexels {
 public:
  UsesOfTexels(Uses& uses, const Texels& texels, Mask seen)
      : uses_(uses), texels_(texels), seen_(seen), use_(find(0)) {}

  /// Null: the colour does not matter, or has none.
  Use* at(size_t texel) {
    const Colour colour = colourAt(texels_, seen_, texel);
    if (!colour) return nullptr;
    if (*colour != last_) {
      last_ = *colour;
      use_ = find(last_);
    }
    return use_;
  }

 private:
  Use* find(uint64_t colour) const {
    const auto found = uses_.find(colour);
    return found == uses_.end() ? nullptr : &found->second;
  }

  Uses& uses_;
  const Texels& texels_;
  Mask seen_;
  uint64_t last_ = 0;
  Use* use_;  ///< of last_
};

}  // namespace

std::vector<uint8_t> photographOf(const Texels& texels, Mask seen) {
  const size_t count = size_t{texels.width} * texels.height;
  Uses uses = repeatedColours(texels, seen);
  size_t alike = 0;
  std::erase_if(
      uses, [&](const auto& use) { return kInRowPart * use.second.alike * kLeastShare < count; });
  for (const auto& [colour, use] : uses) alike += use.alike;
  if (alike * kLeastAlike < count) return {};
  UsesOfTexels use_of(uses, texels, seen);
  for (size_t i = 0; i < count; ++i)
    if (Use* const use = use_of.at(i)) ++use->texels;
  std::vector<uint8_t> photograph(count);
  size_t drawn = 0, left = 0;
  for (size_t i = 0; i < count; ++i) {
    const Use* const use = use_of.at(i);
    photograph[i] = use == nullptr || !use->isDrawn(count);
    drawn += photograph[i] == 0;
    left += photograph[i] != 0 && seen[i];
  }
  if (drawn == 0 || left == 0) return {};
  return photograph;
}

}  // namespace tetrakis::inline mask
