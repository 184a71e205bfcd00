// SPDX-License-Identifier: Apache-2.0
// Interpolation gives texels that are not decoded yet the rounded mean of their coarser neighbours
// in the 4-8 lattice; a root becomes grey.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/view.hpp"
#include "codec/lattice/levels.hpp"
#include "texture_wavelet/drawn/drawn_decoder.hpp"

namespace tetrakis::inline drawn {

/// An image, of which the colours of a part are wanted.
struct DrawnPart {
  Extent extent;  ///< of the image
  Window shown;   ///< the part
  uint16_t*
      samples;  ///< of the whole image, interleaved, of which those that the part needs are set
};

/// Gives texels of one level of an image their colours, in place, as far as a part of the image
/// needs them. Coarser levels are filled.
template <size_t kChannels>
class Interpolation {
 public:
  Interpolation(const Level& level, const DrawnColour& grey, const DrawnPart& image)
      : level_(level), grey_(grey), image_(image) {}

  /// known(texel): true keeps the texel as it is. filled(texel) is called for each of the others.
  template <class Known, class Filled>
  void run(const Known& known, const Filled& filled) {
    if (level_.kind == LevelKind::kRoots) {
      forEachTexel([&](uint32_t, uint32_t, size_t texel, uint16_t* to) {
        if (known(texel)) return;
        std::copy_n(grey_.begin(), kChannels, to);
        filled(texel);
      });
      return;
    }
    const Stencil stencil = stencilOf(level_.kind, level_.step, image_.extent.width);
    std::array<ptrdiff_t, kTaps> taps{};  // in locals, which stay in registers
    for (size_t i = 0; i < kTaps; ++i)
      taps[i] = stencil.linear[i] * static_cast<ptrdiff_t>(kChannels);
    const uint32_t step = level_.step;
    const uint32_t width = image_.extent.width, height = image_.extent.height;
    forEachTexel([&, taps](uint32_t x, uint32_t y, size_t texel, uint16_t* to) {
      if (known(texel)) return;
      if (x >= step && y >= step && x + step < width && y + step < height) {
        const uint16_t *a = to + taps[0], *b = to + taps[1], *c = to + taps[2], *d = to + taps[3];
        for (size_t i = 0; i < kChannels; ++i)
          to[i] = static_cast<uint16_t>((a[i] + b[i] + c[i] + d[i] + 2) / 4);
      } else {
        fillAtBorder(x, y, stencil, to);
      }
      filled(texel);
    });
  }

 private:
  static constexpr size_t kTaps = Stencil::kRingSize[0];

  template <class Visit>
  void forEachTexel(const Visit& visit) {
    const Window needed = neededOf(level_, image_.shown, image_.extent);
    forEachVertex(level_, needed, [&](uint32_t x, uint32_t y) {
      const size_t texel = size_t{y} * image_.extent.width + x;
      visit(x, y, texel, image_.samples + texel * kChannels);
    });
  }

  void fillAtBorder(uint32_t x, uint32_t y, const Stencil& stencil, uint16_t* to) const {
    std::array<uint32_t, kChannels> sums{};
    uint32_t count = 0;
    for (size_t tap = 0; tap < kTaps; ++tap) {
      const int64_t nx = int64_t{x} + stencil.dx[tap], ny = int64_t{y} + stencil.dy[tap];
      if (nx < 0 || ny < 0 || nx >= image_.extent.width || ny >= image_.extent.height) continue;
      const uint16_t* from = to + stencil.linear[tap] * static_cast<ptrdiff_t>(kChannels);
      for (size_t c = 0; c < kChannels; ++c) sums[c] += from[c];
      ++count;
    }
    for (size_t c = 0; c < kChannels; ++c)
      to[c] = static_cast<uint16_t>((sums[c] + count / 2) / count);
  }

  const Level& level_;
  const DrawnColour& grey_;
  const DrawnPart& image_;
};

/// Calls visit.operator()<channels>().
template <class Visit>
void withChannels(uint32_t channels, const Visit& visit) {
  switch (channels) {
    case 1:
      return visit.template operator()<1>();
    case 2:
      return visit.template operator()<2>();
    case 3:
      return visit.template operator()<3>();
    default:
      return visit.template operator()<4>();
  }
}

}  // namespace tetrakis::inline drawn
