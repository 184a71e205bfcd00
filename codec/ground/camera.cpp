// SPDX-License-Identifier: Apache-2.0
#include "codec/ground/camera.hpp"

#include <cmath>

namespace tetrakis::inline ground {

namespace {

bool isFinite(const Vec3& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/// What is wrong with the camera; nullptr: nothing.
const char* faultOf(const Camera& camera) {
  if (!isFinite(camera.eye)) return "has an eye that is not finite";
  if (!isFinite(camera.target)) return "has a target that is not finite";
  if (!isFinite(camera.up)) return "has an up that is not finite";
  const Vec3 sight = subtract(camera.target, camera.eye), direction = normalized(sight);
  if (!std::isfinite(length(sight))) return "has its eye too far from its target";
  if (!(length(direction) > 0)) return "has its target in its eye";
  if (!std::isfinite(length(camera.up))) return "has an up that is too long";
  if (!(length(cross(direction, normalized(camera.up))) > 1e-9))
    return "has an up along its line of sight";
  if (!(camera.fov_y > 0 && camera.fov_y < 180))
    return "has a fov_y that does not lie between 0 and 180 degrees";
  const auto fits = [](uint32_t side) { return side >= 1 && side <= kLargestPicture; };
  if (!fits(camera.width) || !fits(camera.height))
    return "has a picture whose sides are not 1 to 8192 pixels";
  if (!std::isfinite(camera.weight)) return "has a weight that is not finite";
  if (camera.weight < 0) return "has a negative weight";
  return nullptr;
}

}  // namespace

Status checkCamera(const Camera& camera) {
  const char* fault = faultOf(camera);
  return fault ? Status(TKS_USAGE, "Camera '" + camera.name + "' " + fault + ".") : Status();
}

}  // namespace tetrakis::inline ground
