// SPDX-License-Identifier: Apache-2.0
// seeingAll() moves a camera, without turning it, to the nearest place from which it sees the whole
// box of a terrain.
#pragma once

#include "codec/ground/camera.hpp"
#include "codec/ground/frame.hpp"
#include "codec/ground/vec3.hpp"

namespace tetrakis::inline ground {

/// The tangents of half the angles that a picture spans.
struct HalfAngles {
  double tan_x, tan_y;
};

HalfAngles halfAngles(const Camera& camera);

inline Vec3 centreOf(const Bounds& bounds) {
  return scale(add(bounds.low, bounds.high), 0.5);
}

/// Returns the camera, with its direction and its angle, at the nearest place from which it sees
/// the whole box with a small margin, in the middle of the picture.
Camera seeingAll(Camera camera, const Bounds& bounds);

}  // namespace tetrakis::inline ground
