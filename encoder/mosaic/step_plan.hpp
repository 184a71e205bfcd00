// SPDX-License-Identifier: Apache-2.0
// chooseSteps() turns what a survey has seen into the part of a plan that says how samples become
// steps and how these are coded: base, step and filters, and whether coefficients are cut, with
// corrections behind the cut. Nine fields of the source stand for all of it.
#pragma once

#include "encoder/mosaic/mosaic_plan.hpp"
#include "encoder/mosaic/survey.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline mosaic {

/// plan: with all that the source and the target say of it. TKS_USAGE: the target cannot be
/// promised, with the reason. Errors of `read`.
Status chooseSteps(const Survey& survey, const MosaicOptions& options, const ReadSamples& read,
                   MosaicPlan& plan);

}  // namespace tetrakis::inline mosaic
