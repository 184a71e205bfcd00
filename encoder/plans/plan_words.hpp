// SPDX-License-Identifier: Apache-2.0
// The functions here say parts of a plan in words, in which the C interface hands them out.
#pragma once

#include <string>

#include "encoder/plans/plan.hpp"

namespace tetrakis::inline plans {

/// The filters of level 1, of level 2 and of all coarser ones: "six-tap, six-tap, quiet". Empty if
/// the plan names none.
std::string filterWords(const Plan& plan);

/// The layers: "mask, flat areas". Empty if there are none.
std::string layerWords(const Plan& plan);

/// Empty if there is no residual.
const char* predictorWords(const Plan& plan);

}  // namespace tetrakis::inline plans
