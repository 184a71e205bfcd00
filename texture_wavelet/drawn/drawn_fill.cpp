// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn/drawn_fill.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "lattice/levels.hpp"
#include "lattice/stencil.hpp"

namespace tetrakis::inline drawn {

namespace {

template <size_t kChannels>
class Filling {
 public:
  Filling(std::span<const DrawnIndex> indices, const DrawnColours& colours, Texels& texels)
      : indices_(indices.data()),
        colours_(colours),
        samples_(texels.samples.data()),
        width_(texels.width),
        height_(texels.height),
        grey_(greyOf(texels)) {}

  void fill(const Level& level) {
    const Stencil stencil =
        level.kind == LevelKind::kRoots ? Stencil{} : stencilOf(level.kind, level.step, width_);
    for (uint32_t row = 0; row < level.rows; ++row) {
      const uint32_t y = level.y(row);
      uint32_t x = level.firstX(row);
      for (uint32_t i = 0; i < level.columns[row % 2]; ++i, x += level.pitch()) {
        const size_t texel = size_t{y} * width_ + x;
        if (const DrawnIndex index = indices_[texel]; index != kNoIndex) {
          std::copy_n(colours_[index].begin(), kChannels, samples_ + texel * kChannels);
        } else if (level.kind == LevelKind::kRoots) {
          std::copy_n(grey_.begin(), kChannels, samples_ + texel * kChannels);
        } else {
          interpolate(x, y, level.step, stencil);
        }
      }
    }
  }

 private:
  void interpolate(uint32_t x, uint32_t y, uint32_t step, const Stencil& stencil) {
    constexpr int kTaps = Stencil::kRingSize[0];
    uint16_t* const to = samples_ + (size_t{y} * width_ + x) * kChannels;
    const bool inside = x >= step && y >= step && x + step < width_ && y + step < height_;
    std::array<uint32_t, kChannels> sums{};
    uint32_t count = 0;
    for (int tap = 0; tap < kTaps; ++tap) {
      const int64_t nx = int64_t{x} + stencil.dx[tap], ny = int64_t{y} + stencil.dy[tap];
      if (!inside && (nx < 0 || ny < 0 || nx >= width_ || ny >= height_)) continue;
      const uint16_t* from = to + stencil.linear[tap] * static_cast<ptrdiff_t>(kChannels);
      for (size_t c = 0; c < kChannels; ++c) sums[c] += from[c];
      ++count;
    }
    for (size_t c = 0; c < kChannels; ++c)
      to[c] = static_cast<uint16_t>(count == kTaps ? (sums[c] + kTaps / 2) / kTaps
                                                   : (sums[c] + count / 2) / count);
  }

  const DrawnIndex* indices_;
  const DrawnColours& colours_;
  uint16_t* samples_;
  uint32_t width_, height_;
  DrawnColour grey_;
};

template <size_t kChannels>
void fillLevels(std::span<const Level> levels, std::span<const DrawnIndex> indices,
                const DrawnColours& colours, Texels& texels) {
  Filling<kChannels> filling(indices, colours, texels);
  for (const Level& level : levels) filling.fill(level);
}

}  // namespace

DrawnColour greyOf(const Texels& format) {
  const auto half = static_cast<uint16_t>(1u << (format.bits - 1));
  return {half, half, half, half};
}

void fillDrawn(std::span<const Level> levels, std::span<const DrawnIndex> indices,
               const DrawnColours& colours, Texels& texels) {
  switch (texels.channels) {
    case 1:
      return fillLevels<1>(levels, indices, colours, texels);
    case 2:
      return fillLevels<2>(levels, indices, colours, texels);
    case 3:
      return fillLevels<3>(levels, indices, colours, texels);
    default:
      return fillLevels<4>(levels, indices, colours, texels);
  }
}

}  // namespace tetrakis::inline drawn
