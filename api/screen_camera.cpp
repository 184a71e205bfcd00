// SPDX-License-Identifier: Apache-2.0
#include "api/screen_camera.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

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

Result<std::vector<tks_screen_camera>> takeCameras(const tks_screen_camera* given, uint32_t count) {
  if (count > 0 && given == nullptr) return Status(TKS_USAGE, "The cameras are missing.");
  std::vector<tks_screen_camera> cameras;
  const auto* const bytes = reinterpret_cast<const std::byte*>(given);
  for (uint32_t i = 0; i < count; ++i) {
    const std::string name = "camera " + std::to_string(i + 1) + " of " + std::to_string(count);
    const auto& one = *reinterpret_cast<const tks_screen_camera*>(bytes + i * given->size);
    tks_screen_camera camera{};
    Status status = takeCamera(name, one, camera);
    if (status.ok() && one.size != given->size)
      status = {TKS_USAGE, "All cameras take structs of one size."};
    if (!status.ok()) return status;
    cameras.push_back(camera);
  }
  return cameras;
}

}  // namespace tetrakis::inline api
