// SPDX-License-Identifier: Apache-2.0
// mostDecisions() bounds the number of decisions that bytes can pay for. So the time for a codeword
// is bounded by its bytes, however many samples its plane has.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bitstream/coder/adaptive_bit.hpp"

namespace tetrakis::inline coder {

/// No more decisions count than these of a codeword of so many bytes. Each leaves at most
/// 1 - kFloor / 2^16 of the range and 1, which is less than 2^-24 of it: at least 8.79e-5 bits.
constexpr uint64_t mostDecisions(size_t bytes) {
  constexpr uint64_t kOfByte = 91'100;  // 8 bits / 8.79e-5
  static_assert(AdaptiveBit::kFloor == 4 && AdaptiveBit::kPrecision == 16);
  return kOfByte * (bytes + 1);
}

}  // namespace tetrakis::inline coder
