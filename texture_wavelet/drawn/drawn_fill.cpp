// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn/drawn_fill.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/zeroed_array.hpp"
#include "texture_wavelet/drawn/drawn_interpolation.hpp"

namespace tetrakis::inline drawn {

namespace {

template <size_t kChannels>
void fillLevels(std::span<const Level> levels, std::span<const KeptIndex> indices,
                const DrawnColours& colours, const DrawnColour& grey, const DrawnPart& part) {
  uint16_t* const samples = part.samples;
  const auto known = [&](size_t texel) {
    const DrawnIndex index = indices[texel];
    if (index == kNoIndex) return false;
    std::copy_n(colours[index].begin(), kChannels, samples + texel * kChannels);
    return true;
  };
  for (const Level& level : levels)
    Interpolation<kChannels>(level, grey, part).run(known, [](size_t) {});
}

}  // namespace

DrawnColour greyOf(const Texels& format) {
  const auto half = static_cast<uint16_t>(1u << (format.bits - 1));
  return {half, half, half, half};
}

void fillDrawn(std::span<const Level> levels, std::span<const KeptIndex> indices,
               const DrawnColours& colours, Texels& texels) {
  const DrawnPart whole{
      texels.extent(), {0, 0, texels.width, texels.height}, texels.samples.data()};
  withChannels(texels.channels, [&]<size_t kChannels>() {
    fillLevels<kChannels>(levels, indices, colours, greyOf(texels), whole);
  });
}

void fillDrawn(std::span<const Level> levels, std::span<const KeptIndex> indices,
               const DrawnColours& colours, Extent whole, const Window& window, Texels& texels) {
  const uint32_t channels = texels.channels;
  ZeroedArray<uint16_t> samples(whole.samples() * channels);  // few of which are touched
  withChannels(channels, [&]<size_t kChannels>() {
    fillLevels<kChannels>(levels, indices, colours, greyOf(texels),
                          {whole, window, samples.data()});
  });
  texels.samples =
      slice(std::span<const uint16_t>(samples.data(), samples.size()),
            {whole.width * channels, whole.height},
            {0, Window{window.x * channels, window.y, window.width * channels, window.height}});
}

}  // namespace tetrakis::inline drawn
