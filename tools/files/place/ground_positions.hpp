// SPDX-License-Identifier: Apache-2.0
// Longitudes and latitudes for receivers that know few reference systems, as browsers do: PROJ
// tells them, and the stream takes them along.
#pragma once

#include <string>

#include "tools/files/files.hpp"

namespace tetrakis::tools {

/// Gives heights, texture or both their positions where browsers need them and `most_bytes` hold
/// them; either may be null. What cannot be fitted is told by the sentence that comes back, ""
/// else.
std::string addPositions(HeightFile* heights, ImageFile* image, uint64_t most_bytes);

}  // namespace tetrakis::tools
