// SPDX-License-Identifier: Apache-2.0
// codeResidual() codes the difference between a value that appears for the first time and its
// prediction.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "bitstream/coder/adaptive_bit.hpp"

namespace tetrakis::inline drawing {

/// Number i: the magnitude has more than i bits.
template <size_t kClasses>
using ResidualModels = std::array<AdaptiveBit, kClasses>;

/// Bits of the magnitude one by one, then its digits and the sign. Its models are all the bits that
/// it has at most. A magnitude of 32 bits wraps.
template <size_t kClasses, class Io>
int32_t codeResidual(ResidualModels<kClasses>& models, int32_t ours, Io& io) {
  const auto word = static_cast<uint32_t>(ours);
  const uint32_t our_magnitude = ours < 0 ? 0 - word : word;
  const auto our_bits = static_cast<size_t>(std::bit_width(our_magnitude));
  size_t bits = 0;
  while (bits < kClasses && io.bit(models[bits], our_bits > bits)) ++bits;
  if (bits == 0) return 0;
  uint32_t magnitude = 1;
  for (size_t position = bits - 1; position-- > 0;)
    magnitude = 2 * magnitude + io.evenBit((our_magnitude >> position) & 1);
  return static_cast<int32_t>(io.evenBit(ours < 0) ? 0 - magnitude : magnitude);
}

}  // namespace tetrakis::inline drawing
