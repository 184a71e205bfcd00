// SPDX-License-Identifier: Apache-2.0
// fewValues() and shortExactHeights() make exact heights for a byte budget by means that lossy
// heights do not have: drawings, tables of values, and corrections from neighbours.
#pragma once

#include <optional>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/targets/candidates.hpp"

namespace tetrakis::inline targets {

/// Heights of few values to the last bit, of which the budget holds a large part. Lossy heights
/// have no drawings and no tables of values, and may never come as near.
struct FewValues {
  HeightsCandidate heights;  ///< with their curve; `coded` is null: there are none
  bool fit = false;          ///< see fewValues()
};

/// Codes heights of few values. `fit` says that they are taken even if prefixes lose by it: a table
/// has to save half of the budget for that; a drawing, or corrections in the place of a table, have
/// saved enough in any case.
FewValues fewValues(const EncodeInputs& inputs, const HeightsCandidate& lossy);

/// Whether the part of the exact heights that the budget holds is nearer to the samples than its
/// part of the lossy ones. Both have curves. room: bytes for packets.
bool isNearer(const EncodeInputs& inputs, const HeightsCandidate& exact,
              const HeightsCandidate& lossy, uint64_t room);

/// The shortest heights to the last bit, if they take clearly less than the budget; else `coded` is
/// null. Their prefixes are those of lossless heights, so they serve budgets in which no other
/// heights are exact. few: from fewValues(), which need no second coding.
HeightsCandidate shortExactHeights(const EncodeInputs& inputs, const HeightsCandidate& lossy,
                                   const HeightsCandidate& few);

}  // namespace tetrakis::inline targets
