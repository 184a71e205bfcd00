// SPDX-License-Identifier: Apache-2.0
// decodeCorrections() and decodeExactSteps() turn a codeword and hints into the corrections of
// steps (correction_coder.hpp) and into exact steps (exact_corrections.hpp), row by row.
// activityHints() makes the hints, which both sides take from the significant coefficients.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "codec/geometry/corrections/correction_coder.hpp"

namespace tetrakis::inline corrections {

// activityHints() counts the significant coefficients near each sample: where there are some,
// corrections of steps are larger, so the count is a context for them.

/// Returns the hints (correction_coder.hpp) of corrections of steps: how many of a vertex and its
/// four neighbours are significant. significant: of the samples of a part.
std::vector<uint8_t> activityHints(std::span<const uint8_t> significant, Extent extent);

// decodeCorrections() decodes a codeword of corrections (correction_coder.hpp) into one small
// integer for each sample.

/// Takes corrections from sample `first` on, all of one row: integers modulo 2^32, 0 where samples
/// are void.
using TakeCorrections = std::function<void(size_t first, std::span<const int32_t> row)>;

/// Hands over the corrections row by row, as far as they are decided. codeword: any prefix of a
/// codeword of encodeCorrections(). Safe on any bytes.
void decodeCorrections(std::span<const uint8_t> codeword, const CorrectionHints& hints,
                       const TakeCorrections& take);

// decodeExactSteps() decodes exact corrections (exact_corrections.hpp), which turn decoded heights
// into whole steps again.

/// Takes whole steps from sample `first` on, all of one row; 0 where samples are void.
using TakeSteps = std::function<void(size_t first, std::span<const int32_t> row)>;

/// Hands over the steps row by row, as far as they are decided. codeword: any prefix of a codeword
/// of encodeExactSteps() for the same heights, which are in units of 2^-fraction_bits steps; those
/// of a row may change once the row is handed over. Safe on any bytes.
void decodeExactSteps(std::span<const uint8_t> codeword, const PlaneView<const int32_t>& heights,
                      int fraction_bits, const TakeSteps& take);

}  // namespace tetrakis::inline corrections
