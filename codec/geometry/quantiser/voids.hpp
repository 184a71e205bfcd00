// SPDX-License-Identifier: Apache-2.0
// findVoids() finds the samples of a height field that are valid, from its nodata value and NaN.
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "base/status.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline quantiser {

/// Returns one byte for each sample, which is 1 where the sample is valid and 0 where it is void,
/// or nothing if all samples are valid. A sample is void if it equals heights.nodata (and there is
/// has_nodata) or is NaN. TKS_USAGE: a sample is infinite; its place is in the message.
Result<std::vector<uint8_t>> findVoids(const tks_heights& heights);

/// The smallest and the largest of the valid samples; both are 0 if no sample is valid.
struct SampleRange {
  double low = 0, high = 0;
};
SampleRange rangeOf(const tks_heights& heights, Mask valid);

}  // namespace tetrakis::inline quantiser
