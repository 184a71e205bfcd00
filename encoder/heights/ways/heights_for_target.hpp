// SPDX-License-Identifier: Apache-2.0
// codeHeightsForTarget() codes quantised heights in the way that the target of the options asks
// for: this is where the branches for bytes, a PSNR, a largest error and lossless begin
// (docs/ARCHITECTURE.md, "How heights are coded").
#pragma once

#include <memory>

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline ways {

/// quantised: from quantiseHeights(inputs).
std::shared_ptr<const CodedHeights> codeHeightsForTarget(
    const EncodeInputs& inputs, std::shared_ptr<const QuantisedHeights> quantised);

}  // namespace tetrakis::inline ways
