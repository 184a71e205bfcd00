// SPDX-License-Identifier: Apache-2.0
// codeLosslessHeights() codes heights to the last bit in the way that takes the fewest bytes:
// coefficients without fraction bits; a cut of lossy coefficients with corrections behind it (of
// steps, from a relative step, or of facets); or a drawing.
#pragma once

#include <memory>

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline ways {

/// Codes every step exactly in the way that takes the fewest bytes: coefficients, corrections
/// behind a cut, or a drawing. Steps need not restore samples: those of a largest error do not.
std::shared_ptr<const CodedHeights> codeEveryStep(
    const EncodeInputs& inputs, const std::shared_ptr<const QuantisedHeights>& quantised);

/// quantised: from quantiseHeights(inputs).
std::shared_ptr<const CodedHeights> codeLosslessHeights(
    const EncodeInputs& inputs, const std::shared_ptr<const QuantisedHeights>& quantised);

}  // namespace tetrakis::inline ways
