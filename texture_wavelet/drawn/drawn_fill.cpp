// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn/drawn_fill.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "texture_wavelet/drawn/drawn_interpolation.hpp"

namespace tetrakis::inline drawn {

namespace {

template <size_t kChannels>
void fillLevels(std::span<const Level> levels, std::span<const DrawnIndex> indices,
                const DrawnColours& colours, Texels& texels) {
  const DrawnColour grey = greyOf(texels);
  uint16_t* const samples = texels.samples.data();
  const auto known = [&](size_t texel) {
    const DrawnIndex index = indices[texel];
    if (index == kNoIndex) return false;
    std::copy_n(colours[index].begin(), kChannels, samples + texel * kChannels);
    return true;
  };
  for (const Level& level : levels)
    Interpolation<kChannels>(level, grey, texels).run(known, [](size_t) {});
}

}  // namespace

DrawnColour greyOf(const Texels& format) {
  const auto half = static_cast<uint16_t>(1u << (format.bits - 1));
  return {half, half, half, half};
}

void fillDrawn(std::span<const Level> levels, std::span<const DrawnIndex> indices,
               const DrawnColours& colours, Texels& texels) {
  withChannels(texels.channels, [&]<size_t kChannels>() {
    fillLevels<kChannels>(levels, indices, colours, texels);
  });
}

}  // namespace tetrakis::inline drawn
