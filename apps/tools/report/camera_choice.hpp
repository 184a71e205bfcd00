// SPDX-License-Identifier: Apache-2.0
// chooseCameras() makes the cameras that a command names, and toldCameras() turns them into cameras
// for an encoder.
#pragma once

#include <string>
#include <vector>

#include "apps/tools/files/place/ground_axes.hpp"
#include "apps/tools/render/render.hpp"
#include "codec/ground/camera.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::tools {

/// The cameras of --cameras FILE or --view NAME; both empty: the oblique view.
struct CameraChoice {
  std::string file;
  std::string view;
  bool isDefault() const { return file.empty() && view.empty(); }
};

/// `bounds`: of what preset cameras look at.
Result<std::vector<Camera>> chooseCameras(const CameraChoice& choice, const Bounds& bounds);

/// As encoders are told of them, whose x runs along rows and z down columns: exactly, where these
/// are perpendicular. The names are those of `cameras`, which outlive the result.
std::vector<tks_camera> toldCameras(const std::vector<Camera>& cameras, const GroundAxes& axes);

}  // namespace tetrakis::tools
