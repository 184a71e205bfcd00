// SPDX-License-Identifier: Apache-2.0
// takeCamera() checks a camera of a caller and copies it into the struct of this library.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/status.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

/// What the caller has of a camera; fields that it lacks are 0. TKS_USAGE, TKS_UNSUPPORTED with a
/// sentence that begins with `name` or holds it.
Status takeCamera(const std::string& name, const tks_screen_camera& given, tks_screen_camera& out);

/// All cameras of an array of structs of one size.
Result<std::vector<tks_screen_camera>> takeCameras(const tks_screen_camera* given, uint32_t count);

/// How much a camera counts beside others.
inline double weightOf(const tks_screen_camera& camera) {
  return camera.weight > 0 ? camera.weight : 1;
}

}  // namespace tetrakis::inline api
