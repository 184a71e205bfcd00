// SPDX-License-Identifier: Apache-2.0
// Cameras as callers hand them over.
#pragma once

#include <string>

#include "base/status.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

/// What the caller has of a camera; fields that it lacks are 0. TKS_USAGE, TKS_UNSUPPORTED with a
/// sentence that begins with `name` or holds it.
Status takeCamera(const std::string& name, const tks_screen_camera& given, tks_screen_camera& out);

}  // namespace tetrakis::inline api
