// SPDX-License-Identifier: Apache-2.0
// Where a byte budget comes near the last bit: the last bit-planes of lossy coefficients can take
// more bytes than it does to have all samples right. This file tries that, for everything and for
// the heights alone, and keeps it where the budget buys more by it.
#pragma once

#include <optional>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/selection/selection.hpp"
#include "encoder/targets/candidates.hpp"

namespace tetrakis::inline targets {

/// All packets of components that end exact: of both, if that fits the budget and takes nothing
/// from prefixes; else of the heights, if the cameras see fewer errors for it or, without a
/// texture, if the shortest ones take clearly less than the budget or are of few values and nearer
/// than lossy ones as far as the budget holds them. Nothing where none of this pays. lossy: with
/// curves, and what they come to: selection.
std::optional<Selection> exactWithinBudget(const EncodeInputs& inputs, const Candidates& lossy,
                                           const Selection& selection);

}  // namespace tetrakis::inline targets
