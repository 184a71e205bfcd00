// SPDX-License-Identifier: Apache-2.0
// Alpha as the last of two or four channels.
#pragma once

#include "tools/files/files.hpp"

namespace tetrakis::tools {

/// No alpha, or nothing but its largest value.
bool isOpaque(const ImageFile& image);

/// Turns colours that were multiplied by alpha into plain ones, rounded; those under alpha 0 stay.
void divideByAlpha(ImageFile& image);

}  // namespace tetrakis::tools
