// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn/drawn_error.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "texture_wavelet/drawn/drawn_fill.hpp"
#include "texture_wavelet/drawn/drawn_interpolation.hpp"

namespace tetrakis::inline drawn {

namespace {

/// Fills the unknown texels and returns their squared error.
template <size_t kChannels>
uint64_t squaresOfUnknown(std::span<const Level> levels, std::span<const KeptIndex> indices,
                          const Texels& original, Texels& shown) {
  const DrawnColour grey = greyOf(shown);
  const uint16_t *const truth = original.samples.data(), *const seen = shown.samples.data();
  uint64_t squares = 0;
  const auto known = [indices](size_t texel) { return indices[texel] != kNoIndex; };
  const auto filled = [truth, seen, &squares](size_t texel) {
    for (size_t k = texel * kChannels; k < (texel + 1) * kChannels; ++k) {
      const auto off = static_cast<uint32_t>(int32_t{truth[k]} - seen[k]);
      squares += off * off;
    }
  };
  const DrawnPart whole{shown.extent(), {0, 0, shown.width, shown.height}, shown.samples.data()};
  for (const Level& level : levels) Interpolation<kChannels>(level, grey, whole).run(known, filled);
  return squares;
}

}  // namespace

double DrawnError::squares(std::span<const KeptIndex> indices) {
  std::copy(original_.samples.begin(), original_.samples.end(), shown_.samples.begin());
  uint64_t squares = 0;
  withChannels(original_.channels, [&]<size_t kChannels>() {
    squares = squaresOfUnknown<kChannels>(levels_, indices, original_, shown_);
  });
  return static_cast<double>(squares);
}

}  // namespace tetrakis::inline drawn
