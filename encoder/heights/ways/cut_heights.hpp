// SPDX-License-Identifier: Apache-2.0
// cutAt() and codeUpTo() end the coefficients of heights, in one track or in many, where a given
// squared error is reached. Corrections follow such a cut (encoder/heights/followed_heights.hpp).
#pragma once

#include <memory>
#include <optional>

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline ways {

/// The heights cut where their squared error, in steps, falls to so much: what takes off most error
/// a byte is kept of all tracks. Nothing if they do not come so far. whole: without corrections.
std::optional<CodedHeights> cutAt(const CodedHeights& whole, double squares);

/// Lossy heights coded up to a mean squared error, in steps, or whole if they do not come so far.
CodedHeights codeUpTo(const EncodeInputs& inputs, std::shared_ptr<const QuantisedHeights> quantised,
                      double mean_square);

}  // namespace tetrakis::inline ways
