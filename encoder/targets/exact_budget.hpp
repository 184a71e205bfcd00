// SPDX-License-Identifier: Apache-2.0
// exactWithinBudget() tries heights and texture to the last bit where a byte budget comes near to
// it: the last bit-planes of lossy coefficients can take more bytes than exact samples do. It tries
// both components, then the heights alone, beside the lossy candidates, and holds the pictures of
// their prefixes against each other: exact heights are taken if the picture is better with the
// whole budget, by more decibels than it loses with 1/16 to 3/4 of the budget together.
#pragma once

#include <optional>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/selection/selection.hpp"
#include "encoder/targets/candidates.hpp"

namespace tetrakis::inline targets {

/// All packets of components that end exact. Both components are exact if they fit the budget and
/// prefixes lose nothing. Else the heights are exact if the cameras see fewer errors for it or,
/// without a texture, if the shortest exact heights take clearly less than the budget, or are of
/// few values and nearer than lossy ones as far as the budget holds them. Nothing if no exact
/// component pays. lossy: with curves; selection: the packets chosen of them.
std::optional<Selection> exactWithinBudget(const EncodeInputs& inputs, const Candidates& lossy,
                                           const Selection& selection);

}  // namespace tetrakis::inline targets
