// SPDX-License-Identifier: Apache-2.0
// Some samples are on no grid of steps: most floats, and integers of a wide range. Lossy heights
// count coarse steps for them, and end with an error however large the budget is. Corrections of
// the samples behind the last coefficient make the end exact, and leave all prefixes as they are.
// Where samples have a relative step (codec/geometry/relative/) corrections follow a cut.
#pragma once

#include <optional>

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline heights {

/// Whether lossy heights can be followed by corrections of the samples: they are coded whole, in
/// one track, and are no lossless heights yet.
bool canBeRestored(const CodedHeights& lossy);

/// The relative step of what lossy heights show, if corrections from it can follow a cut of theirs;
/// 0: there is none.
double relativeStepOf(const CodedHeights& lossy);

/// The RMSE of the cut, in relative steps. Behind finer ones coefficients code what samples do not
/// have, behind coarser ones more of the multiples are missed.
inline constexpr double kRelativeCut = 0.3;

/// The heights cut there, and the corrections behind them; nothing if they do not come so far.
/// relative_step: positive, from relativeStepOf().
std::optional<CodedHeights> codeRelative(const CodedHeights& lossy, double relative_step,
                                         uint32_t threads);

/// Heights to the last bit, in any number of tracks. of: from quantiseForRelative().
CodedHeights codeRelative(const EncodeInputs& inputs,
                          const std::shared_ptr<const QuantisedHeights>& of, double relative_step);

/// The heights with their coefficients as they are and the corrections behind them. lossy:
/// canBeRestored().
CodedHeights codeRestored(const EncodeInputs& inputs, const CodedHeights& lossy);

}  // namespace tetrakis::inline heights
