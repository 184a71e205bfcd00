// SPDX-License-Identifier: Apache-2.0
// codeBoundedHeights() codes heights so that no sample is off by more than the largest error e, in
// steps, that the options allow. It tries two ways and keeps the one of fewer bytes:
//
//   round     heights become multiples of 2 e + 1 steps (floats of twice the bound) and are coded
//             to the last bit. This is best where the error wanted is near the noise of the
//             heights.
//   correct   the coefficients are cut, and what then is off by more than e gets a correction in
//             multiples of 2 e + 1 (corrected_heights.hpp). This is best above: at 5 m on mountains
//             it takes half the bytes of rounding.
//
// Cutting so late that nothing is off by more than e takes up to twice the bytes of either.
#pragma once

#include <memory>

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline ways {

/// quantised: from quantiseHeights(inputs). inputs: with a max_error.
std::shared_ptr<const CodedHeights> codeBoundedHeights(
    const EncodeInputs& inputs, std::shared_ptr<const QuantisedHeights> quantised);

}  // namespace tetrakis::inline ways
