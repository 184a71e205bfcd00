// SPDX-License-Identifier: Apache-2.0
// planOf() reads the plan of coded heights from their header, so that a plan cannot differ from
// what was coded. note() and noteExpected() tell the notes of an encoding, if somebody asked for
// them, of heights that were weighed.
#pragma once

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/plans/plan_notes.hpp"

namespace tetrakis::inline heights {

Plan planOf(const CodedHeights& coded);

/// The plan of heights that are not coded yet, as far as it is known before: without filters, flat
/// areas or a residual.
Plan planOf(const QuantisedHeights& quantised, Coding base);

/// Notes heights that were coded. need: bytes of its tracks that the target needs, at most.
void note(const EncodeInputs& inputs, const CodedHeights& coded, Verdict verdict,
          uint64_t need = UINT64_MAX);

/// Notes a plan that is not tried, because it is expected to take so many bytes. An estimate that
/// is infinite, as of heights without samples, says nothing and is not noted.
void noteExpected(const EncodeInputs& inputs, Plan plan, double bytes);

}  // namespace tetrakis::inline heights
