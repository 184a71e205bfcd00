// SPDX-License-Identifier: Apache-2.0
// codeRestored() appends corrections of the samples to lossy heights, so that the complete stream
// is exact and all prefixes stay as they are. It serves samples that are on no grid of steps (most
// floats, and integers of a wide range): lossy heights count coarse steps for such samples, and
// would end with an error however large the budget is.
#pragma once

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline ways {

/// The whole steps that a decoder computes from all bytes.
HeightSteps shownSteps(const CodedHeights& heights, uint32_t threads);

/// Whether lossy heights can be followed by corrections of the samples: they are coded whole, and
/// are no lossless heights yet.
bool canBeRestored(const CodedHeights& lossy);

/// The heights with their coefficients as they are and the corrections behind them. lossy:
/// canBeRestored().
CodedHeights codeRestored(const EncodeInputs& inputs, const CodedHeights& lossy);

}  // namespace tetrakis::inline ways
