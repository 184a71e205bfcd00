// SPDX-License-Identifier: Apache-2.0
#include "bitstream/reconstruction.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "bitstream/band_models.hpp"

namespace tetrakis {

namespace {

/// Offset of a significant coefficient from the low end of its interval, in 1/64 of the interval,
/// by the class of its neighbours' magnitudes. Means over terrain and aerial images.
constexpr std::array<int, BandModels::kLocal> kCentroid = {16, 19, 20, 22, 23, 25,
                                                           27, 28, 29, 30, 30};

}  // namespace

/// What the sign of each neighbour says about an insignificant coefficient, in 1/64 of the interval
/// that it is known to lie in. Means over terrain and aerial images.
Reconstruction::SignWeights Reconstruction::weightsOf(Orientation orientation) {
  if (orientation == Orientation::kLL) return {0, 0, 0};
  if (orientation == Orientation::kHH) return {-3, -3, 1};
  return {-8, 3, -1};
}

Reconstruction::Reconstruction(const Band& band, int fraction_bits)
    : band_(band),
      fraction_bits_(fraction_bits),
      neighbours_(band.shape, band.orientation),
      weights_(weightsOf(band.orientation)) {}

void Reconstruction::row(uint32_t row, int32_t* values) const {
  const BandShape& shape = band_.shape;
  for (uint32_t x = 0; x < shape.words(); ++x) {
    const uint32_t count = std::min(32u, shape.columns - 32 * x);
    const size_t word = shape.word(row, x), first = shape.cell(row, 32 * x);
    const uint32_t significant_here = band_.significant[word], visited = band_.visited[word];
    uint32_t todo = (significant_here | band_.nearSignificant(word)) & shape.valid(x);
    int32_t* out = values + 32 * x;
    std::fill_n(out, count, 0);
    for (; todo != 0; todo &= todo - 1) {
      const auto i = static_cast<uint32_t>(std::countr_zero(todo));
      const int plane = band_.plane + 1 - static_cast<int>((visited >> i) & 1);
      out[i] = (significant_here >> i) & 1 ? significant(first + i, plane)
                                           : insignificant(first + i, plane);
    }
  }
}

/// sixtyfourths / 64 * 2^plane in output units, rounded towards zero.
int32_t Reconstruction::fraction(int sixtyfourths, int plane) const {
  const auto magnitude = static_cast<uint64_t>(sixtyfourths < 0 ? -sixtyfourths : sixtyfourths);
  const auto value =
      static_cast<int32_t>(static_cast<uint32_t>((magnitude << (plane + fraction_bits_)) >> 6));
  return sixtyfourths < 0 ? -value : value;
}

int32_t Reconstruction::significant(size_t cell, int plane) const {
  const uint32_t* m = band_.magnitude.data() + cell;
  auto value = static_cast<int32_t>(*m << fraction_bits_);
  if (plane > 0) {
    uint32_t near = 0, far = 0;
    for (ptrdiff_t n : neighbours_.near) near += std::min(m[n] >> plane, 30u);
    for (ptrdiff_t n : neighbours_.far) far += std::min(m[n] >> plane, 30u);
    value += fraction(kCentroid[kLocalClass[std::min(2 * near + far, 255u)]], plane);
  }
  return band_.sign[cell] * value;
}

int32_t Reconstruction::insignificant(size_t cell, int plane) const {
  if (plane == 0) return 0;
  const int8_t* s = band_.sign.data() + cell;
  const auto &near = neighbours_.near, &far = neighbours_.far;
  return fraction(weights_.along * (s[near[0]] + s[near[1]]) +
                      weights_.across * (s[near[2]] + s[near[3]]) +
                      weights_.diagonal * (s[far[0]] + s[far[1]] + s[far[2]] + s[far[3]]),
                  plane);
}

}  // namespace tetrakis
