// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/camera_choice.hpp"

#include "codec/ground/camera.hpp"

namespace tetrakis::tools {

Result<std::vector<Camera>> chooseCameras(const CameraChoice& choice, const Bounds& bounds) {
  if (!choice.file.empty()) return readCameras(choice.file);
  return presetCameras(choice.view.empty() ? "oblique" : choice.view, bounds);
}

std::vector<tks_camera> toldCameras(const std::vector<Camera>& cameras, const GroundAxes& axes) {
  const auto tell = [&axes](const Vec3& from, double* to) {
    const auto [along, down] = axes.unplaced(from[0], from[2]);
    to[0] = along;
    to[1] = from[1];
    to[2] = down;
  };
  std::vector<tks_camera> told;
  for (const Camera& camera : cameras) {
    tks_camera& c = told.emplace_back();
    c.name = camera.name.c_str();
    tell(camera.eye, c.eye);
    tell(camera.target, c.target);
    tell(camera.up, c.up);
    c.fov_y = camera.fov_y;
    c.width = camera.width;
    c.height = camera.height;
    c.weight = camera.weight;
  }
  return told;
}

}  // namespace tetrakis::tools
