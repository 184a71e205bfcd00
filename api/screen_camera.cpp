// SPDX-License-Identifier: Apache-2.0
#include "api/screen_camera.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "api/sized.hpp"

namespace tetrakis::inline api {
namespace {

Status checkCamera(const std::string& name, const tks_screen_camera& camera) {
  constexpr uint32_t kMostPixels = 32768;
  const auto fits = [](uint32_t side) { return side >= 1 && side <= kMostPixels; };
  if (!fits(camera.width) || !fits(camera.height))
    return {TKS_USAGE, "The picture of " + name + " takes sides of 1 to " +
                           std::to_string(kMostPixels) + " pixels."};
  if (!std::all_of(camera.clip, camera.clip + 16, [](double v) { return std::isfinite(v); }))
    return {TKS_USAGE, "The matrix of " + name + " must be finite."};
  if (!std::isfinite(camera.weight) || camera.weight < 0)
    return {TKS_USAGE, "The weight of " + name + " must be finite and not negative."};
  return {};
}

}  // namespace

Status takeCamera(const std::string& name, const tks_screen_camera& given, tks_screen_camera& out) {
  const Status status = takeSized(name, given, offsetof(tks_screen_camera, weight), out);
  return status.ok() ? checkCamera(name, out) : status;
}

}  // namespace tetrakis::inline api
