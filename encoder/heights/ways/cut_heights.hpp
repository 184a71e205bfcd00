// SPDX-License-Identifier: Apache-2.0
// cutAt() and codeUpTo() end the coefficients of heights, in one track or in many, where a given
// squared error is reached. Corrections follow such a cut (encoder/heights/followed_heights.hpp).
#pragma once

#include <memory>
#include <optional>

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline ways {

/// The heights cut where their squared error falls to `squares`, in steps: of all tracks the bytes
/// remain that take off most error. Nothing if the heights do not reach this error. whole: without
/// corrections.
std::optional<CodedHeights> cutAt(const CodedHeights& whole, double squares);

/// Lossy heights coded up to a mean squared error, in steps; whole if they do not reach it.
CodedHeights codeUpTo(const EncodeInputs& inputs, std::shared_ptr<const QuantisedHeights> quantised,
                      double mean_square);

}  // namespace tetrakis::inline ways
