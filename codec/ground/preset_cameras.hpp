// SPDX-License-Identifier: Apache-2.0
// presetCameras() makes cameras from the name of a view and the bounds of a terrain, so that a user
// needs no file of cameras.
#pragma once

#include <string>
#include <vector>

#include "base/status.hpp"
#include "codec/ground/camera.hpp"
#include "codec/ground/frame.hpp"

namespace tetrakis::inline ground {

/// Named view of a terrain, from the south, north up: "oblique" (sees all of it, 35 degrees above
/// the horizon), "low" (from just above the highest ground, sees about a tenth before the sky),
/// "top" (sees all of it, straight down). "all" gives the three, "orbit" the oblique view from four
/// sides, "any" those of unknownViewer(). Other names, or bounds that are not finite: TKS_USAGE.
Result<std::vector<Camera>> presetCameras(const std::string& view, const Bounds& bounds);

/// A mix for a viewer of whom nothing is known: the oblique and the low view from four sides, which
/// count as one each, and the top view. Bounds that are not finite: TKS_USAGE.
Result<std::vector<Camera>> unknownViewer(const Bounds& bounds);

}  // namespace tetrakis::inline ground
