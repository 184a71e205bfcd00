// SPDX-License-Identifier: Apache-2.0
// drawHeights() and storeHeights() code quantised heights without coefficients: as a drawing of few
// values, or as the samples themselves. The wavelet takes more bytes for heights of few values, and
// for noise.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "encoder/heights/coded_heights.hpp"

namespace tetrakis::inline heights {

/// Codes the heights as a drawing, in the place of coefficients; nothing if they have too many
/// values for one.
std::optional<CodedHeights> drawHeights(std::shared_ptr<const QuantisedHeights> quantised);

/// Stores the samples without coding them. threads: nothing depends on them.
CodedHeights storeHeights(std::shared_ptr<const QuantisedHeights> quantised, uint32_t threads);

}  // namespace tetrakis::inline heights
