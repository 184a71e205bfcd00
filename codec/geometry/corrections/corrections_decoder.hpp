// SPDX-License-Identifier: Apache-2.0
// decodeCorrections() decodes a codeword of corrections (corrections_pass.hpp) into one small
// integer for each sample.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "codec/geometry/corrections/corrections_pass.hpp"

namespace tetrakis::inline corrections {

/// Takes corrections from sample `first` on, all of one row: integers modulo 2^32, 0 where samples
/// are void.
using TakeCorrections = std::function<void(size_t first, std::span<const int32_t> row)>;

/// Hands over the corrections row by row, as far as they are decided. codeword: any prefix of a
/// codeword of encodeCorrections(). Safe on any bytes.
void decodeCorrections(std::span<const uint8_t> codeword, const CorrectionHints& hints,
                       const TakeCorrections& take);

}  // namespace tetrakis::inline corrections
