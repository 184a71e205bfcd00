// SPDX-License-Identifier: Apache-2.0
// Some samples are on no grid of steps: most floats, and integers of a wide range. Lossy heights
// count coarse steps for them, and end with an error however large the budget is. Corrections of
// the samples behind the last coefficient make the end exact, and leave all prefixes as they are.
#pragma once

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline ways {

/// What decoders make of all bytes, in whole steps.
HeightSteps shownSteps(const CodedHeights& heights, uint32_t threads);

/// Whether lossy heights can be followed by corrections of the samples: they are coded whole, and
/// are no lossless heights yet.
bool canBeRestored(const CodedHeights& lossy);

/// The heights with their coefficients as they are and the corrections behind them. lossy:
/// canBeRestored().
CodedHeights codeRestored(const EncodeInputs& inputs, const CodedHeights& lossy);

}  // namespace tetrakis::inline ways
