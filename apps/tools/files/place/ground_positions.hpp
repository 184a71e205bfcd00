// SPDX-License-Identifier: Apache-2.0
// addPositions() computes longitudes and latitudes by PROJ and adds them to heights and texture,
// for receivers that know few reference systems, as browsers do.
#pragma once

#include <string>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

/// Gives heights, texture or both their positions where browsers need them and `most_bytes` hold
/// them; either may be null. What cannot be fitted is told by the sentence that comes back, ""
/// else.
std::string addPositions(HeightFile* heights, ImageFile* image, uint64_t most_bytes);

}  // namespace tetrakis::tools
