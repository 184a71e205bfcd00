// SPDX-License-Identifier: Apache-2.0
// sameGround() tells whether a frame lies where the frames before it do. A stream has one place,
// one reference system and one unit for all of its frames, so another one would be lost. A field
// that a frame leaves empty is as it is in the first one.
#pragma once

#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

bool sameGround(const tks_heights& frame, const tks_heights& first);
bool sameGround(const tks_image& frame, const tks_image& first);

}  // namespace tetrakis::inline api
