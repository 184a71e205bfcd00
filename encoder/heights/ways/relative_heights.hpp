// SPDX-License-Identifier: Apache-2.0
// codeRelative() codes samples that have a relative step (codec/geometry/relative/). No grid of
// steps shows them, and yet few bits restore them: the coefficients are cut at a part of the
// relative step, and corrections follow.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline ways {

/// The relative step of the samples of lossy heights, if corrections from it can follow a cut of
/// the heights; 0: there is none.
double relativeStepOf(const CodedHeights& lossy);

/// The lossy heights cut, with corrections behind them; nothing if they do not reach the cut.
/// relative_step: positive, from relativeStepOf().
std::optional<CodedHeights> codeRelative(const CodedHeights& lossy, double relative_step,
                                         uint32_t threads);

/// Codes heights to the last bit, in any number of tracks. quantised: from quantiseForRelative().
CodedHeights codeRelative(const EncodeInputs& inputs,
                          const std::shared_ptr<const QuantisedHeights>& quantised,
                          double relative_step);

}  // namespace tetrakis::inline ways
