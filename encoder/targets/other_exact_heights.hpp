// SPDX-License-Identifier: Apache-2.0
// fewValues() and shortExactHeights() make exact heights for a byte budget by means that lossy
// heights do not have: drawings, tables of values, and corrections from neighbours.
#pragma once

#include <optional>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/targets/candidates.hpp"

namespace tetrakis::inline targets {

/// Heights of few values to the last bit, of which the budget holds a large part. Lossy heights
/// know nothing of drawings or tables of values, and may never come as near.
struct FewValues {
  HeightsCandidate heights;  ///< with their curve; `coded` is null: there are none
  bool fit = false;          ///< see fewValues()
};

/// They fit where they are taken whatever prefixes lose: a table has to save half of the budget for
/// that; a drawing, or corrections in the place of one, have saved enough by what they are.
FewValues fewValues(const EncodeInputs& inputs, const HeightsCandidate& lossy);

/// Whether the part that the budget holds of exact heights is nearer to the samples than its part
/// of the lossy ones. Both have curves. room: bytes for packets.
bool isNearer(const EncodeInputs& inputs, const HeightsCandidate& exact,
              const HeightsCandidate& lossy, uint64_t room);

/// The shortest heights to the last bit, if they take clearly less than the budget; else `coded` is
/// null. Their prefixes are those of lossless heights: for budgets in which no others are exact.
/// few: of fewValues(), which need no second coding.
HeightsCandidate shortExactHeights(const EncodeInputs& inputs, const HeightsCandidate& lossy,
                                   const HeightsCandidate& few);

}  // namespace tetrakis::inline targets
