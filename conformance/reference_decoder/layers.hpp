// SPDX-License-Identifier: Apache-2.0
// Reference decoder: validity, table of values and corrections (docs/FORMAT.md, section 8.1).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {

/// 1 valid, 0 void, row by row.
std::vector<uint8_t> decodeValidity(std::span<const uint8_t> codeword, int width, int height);

/// One a sample, modulo 2^32. plane: which samples are valid. hints: one a sample, 0 to 31.
std::vector<uint32_t> decodeCorrections(std::span<const uint8_t> codeword, const Plane& plane,
                                        const std::vector<int>& hints);

/// So many words; none if a decision does not count.
std::vector<uint32_t> decodeTable(std::span<const uint8_t> codeword, uint32_t values);

/// Takes up to `count` bytes off the front.
inline std::span<const uint8_t> take(std::span<const uint8_t>& codeword, uint64_t count) {
  const auto taken = codeword.first(std::min<uint64_t>(count, codeword.size()));
  codeword = codeword.subspan(taken.size());
  return taken;
}

}  // namespace tetrakis::reference
