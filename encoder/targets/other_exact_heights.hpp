// SPDX-License-Identifier: Apache-2.0
// Exact heights within a budget that are coded otherwise than the lossy ones: as drawings, by
// tables of values, or by what neighbours tell.
#pragma once

#include <optional>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/targets/candidates.hpp"

namespace tetrakis::inline targets {

/// Heights of few values to the last bit, in less than the budget. Lossy heights know nothing of
/// drawings or tables of values, and may never come as near; so prefixes may be somewhat worse. A
/// table has to save half of the budget for that; a drawing, or corrections in the place of one,
/// have saved enough by what they are.
std::optional<HeightsCandidate> fewValues(const EncodeInputs& inputs,
                                          const HeightsCandidate& lossy);

/// The shortest heights to the last bit, if they take clearly less than the budget; else `coded` is
/// null. Their prefixes are those of lossless heights: for budgets in which no others are exact.
HeightsCandidate shortExactHeights(const EncodeInputs& inputs);

}  // namespace tetrakis::inline targets
