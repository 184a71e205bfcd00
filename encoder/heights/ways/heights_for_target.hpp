// SPDX-License-Identifier: Apache-2.0
// Heights as the target of the options asks for them: whichever of the ways to code them that is.
#pragma once

#include <memory>

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline ways {

/// quantised: from quantiseHeights(inputs).
std::shared_ptr<const CodedHeights> codeHeightsForTarget(
    const EncodeInputs& inputs, std::shared_ptr<const QuantisedHeights> quantised);

}  // namespace tetrakis::inline ways
