// SPDX-License-Identifier: Apache-2.0
// turned() turns a picture by quarters and mirrors it, as the orientation of its file says.
#pragma once

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/place/ground_axes.hpp"

namespace tetrakis::tools {

/// The picture, and where its pixels lie, if that is known.
ImageFile turned(const ImageFile& stored, const QuarterTurn& turn);

}  // namespace tetrakis::tools
