// SPDX-License-Identifier: Apache-2.0
// reachOf() says of which samples of a forest a level of its inverse transform has to know the
// coefficients, so that the samples in some rectangles come out right.
//
// A step of the lifting reads what lies around a sample, across the sides of patches as well, and
// gives it to all patches that share it. So the rectangles grow with each step, on all patches that
// they reach. They stay one a patch: what lies between two parts of a patch is known as well.
#pragma once

#include <cstdint>
#include <vector>

#include "base/forest.hpp"
#include "base/view.hpp"
#include "codec/wavelet/lifting/lifting_steps.hpp"

namespace tetrakis::inline wavelet {

/// For each patch of a forest a rectangle of its samples; without any where it is not needed.
using PatchWindows = std::vector<Window>;

/// How many samples beyond a sample a step of the lifting reads, in each direction.
uint32_t stepReach(FilterId id);

/// wanted: of patches of (n + 1)^2 samples, with n even. Rectangles of the result begin at even
/// places.
PatchWindows reachOf(const Forest& forest, int64_t n, FilterId id, const PatchWindows& wanted);

}  // namespace tetrakis::inline wavelet
