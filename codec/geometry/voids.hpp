// SPDX-License-Identifier: Apache-2.0
// Which samples of a height field exist.
#pragma once

#include <cstdint>
#include <vector>

#include "base/status.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis {

/// One byte a sample, 1 valid, 0 void; empty where all are valid. Void are samples that equal
/// heights.nodata (if has_nodata) and floats that are NaN. TKS_USAGE: a sample is infinite; its
/// place is in the message.
Result<std::vector<uint8_t>> findVoids(const tks_heights& heights);

/// Smallest and largest of the valid samples; none: 0 and 0.
struct SampleRange {
  double low = 0, high = 0;
};
SampleRange rangeOf(const tks_heights& heights, const std::vector<uint8_t>& valid);

}  // namespace tetrakis
