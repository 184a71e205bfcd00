// SPDX-License-Identifier: Apache-2.0
// Reference decoder: the two components, and integers as the format computes with them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "conformance/reference_decoder/stream.hpp"

namespace tetrakis::reference {

/// "Arithmetic on samples and coefficients wraps modulo 2^32" (FORMAT, notation).
constexpr int32_t wrap(int64_t value) {
  return static_cast<int32_t>(static_cast<uint32_t>(value));
}

/// round(a / 2^k) = (a + 2^(k-1)) >> k; a for k = 0.
constexpr int64_t roundShift(int64_t a, int k) {
  return k == 0 ? a : (a + (int64_t{1} << (k - 1))) >> k;
}

/// Samples of the header's type, little endian (FORMAT 7).
std::vector<uint8_t> decodeHeights(const GeometryHeader& header, std::span<const uint8_t> codeword);

/// Samples of the header's type, channels interleaved, little endian (FORMAT 8).
std::vector<uint8_t> decodeTexture(const TextureHeader& header, std::span<const uint8_t> codeword);

}  // namespace tetrakis::reference
