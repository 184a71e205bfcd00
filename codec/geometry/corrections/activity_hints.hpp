// SPDX-License-Identifier: Apache-2.0
// activityHints() counts the significant coefficients near each sample: where there are some,
// corrections of steps are larger, so the count is a context for them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.hpp"

namespace tetrakis::inline corrections {

/// Returns the hints (corrections_pass.hpp) of corrections of steps: how many of a vertex and its
/// four neighbours are significant. significant: of the samples of a part.
std::vector<uint8_t> activityHints(std::span<const uint8_t> significant, Extent extent);

}  // namespace tetrakis::inline corrections
