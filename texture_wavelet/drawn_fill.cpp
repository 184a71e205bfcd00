// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn_fill.hpp"

#include <array>

#include "lattice/levels.hpp"
#include "lattice/stencil.hpp"

namespace tetrakis {

namespace {

class Filling {
 public:
  explicit Filling(Texels& texels) : texels_(texels) {}

  void copy(uint32_t x, uint32_t y, const DrawnColour& colour) {
    uint16_t* to = at(x, y);
    for (uint32_t c = 0; c < texels_.channels; ++c) to[c] = colour[c];
  }

  void interpolate(uint32_t x, uint32_t y, const Stencil& stencil) {
    std::array<uint32_t, 4> sums{};
    uint32_t count = 0;
    for (int tap = 0; tap < Stencil::kRingSize[0]; ++tap) {
      const int64_t nx = int64_t{x} + stencil.dx[tap], ny = int64_t{y} + stencil.dy[tap];
      if (nx < 0 || ny < 0 || nx >= texels_.width || ny >= texels_.height) continue;
      const uint16_t* from = at(static_cast<uint32_t>(nx), static_cast<uint32_t>(ny));
      for (uint32_t c = 0; c < texels_.channels; ++c) sums[c] += from[c];
      ++count;
    }
    uint16_t* to = at(x, y);
    for (uint32_t c = 0; c < texels_.channels; ++c)
      to[c] = static_cast<uint16_t>((sums[c] + count / 2) / count);
  }

 private:
  uint16_t* at(uint32_t x, uint32_t y) {
    return texels_.samples.data() + (size_t{y} * texels_.width + x) * texels_.channels;
  }

  Texels& texels_;
};

}  // namespace

DrawnColour greyOf(const Texels& format) {
  const auto half = static_cast<uint16_t>(1u << (format.bits - 1));
  return {half, half, half, half};
}

void fillDrawn(std::span<const ColourIndex> indices, const DrawnColours& colours, uint32_t finest,
               Texels& texels) {
  Filling filling(texels);
  for (const Level& level : levelsOf(texels.width, texels.height)) {
    if (level.step < finest) return;
    const Stencil stencil = level.kind == LevelKind::kRoots
                                ? Stencil{}
                                : stencilOf(level.kind, level.step, texels.width);
    for (uint32_t row = 0; row < level.rows; ++row) {
      const uint32_t y = level.y(row);
      uint32_t x = level.firstX(row);
      for (uint32_t i = 0; i < level.columns[row % 2]; ++i, x += level.pitch()) {
        const ColourIndex index = indices[size_t{y} * texels.width + x];
        if (index != kNoColour) {
          filling.copy(x, y, colours[index]);
        } else if (level.kind == LevelKind::kRoots) {
          filling.copy(x, y, greyOf(texels));
        } else {
          filling.interpolate(x, y, stencil);
        }
      }
    }
  }
}

}  // namespace tetrakis
