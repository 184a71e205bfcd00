// SPDX-License-Identifier: Apache-2.0
// A Camera looks at the ground from a place in its GroundFrame, which puts the samples of a grid
// into metres. checkCamera() refuses cameras that see nothing, and presetCameras() and
// unknownViewer() make cameras for callers that name none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/coordinates.hpp"
#include "base/vec3.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline ground {

/// Orthonormal axes of a view: to the right, up in the picture, into the picture.
struct ViewAxes {
  Vec3 right, up, forward;
};

inline ViewAxes viewAxes(const Vec3& eye, const Vec3& target, const Vec3& up) {
  const Vec3 forward = normalized(subtract(target, eye));
  const Vec3 right = normalized(cross(forward, up));
  return {right, cross(right, forward), forward};
}

// GroundFrame says where the samples of a grid of heights lie in space, in metres. The rule for
// grids that do not say how far apart their samples are is in knownFrame() alone: encoders, cameras
// and meshes must see the same ground.

/// Column c, row r and height h, in the unit of the heights, are at
/// ((c - (width - 1) / 2) * spacing_x,
///  h * metres_per_unit,
///  (r - (height - 1) / 2) * spacing_y): x east, y up, z south.
struct GroundFrame {
  uint32_t width = 0, height = 0;
  double spacing_x = 1, spacing_y = 1;  ///< metres
  double metres_per_unit = 1;
};

/// The frame of a grid of which 0 metres per sample are known: that of the other direction, or
/// kUnknownSpacing.
inline GroundFrame knownFrame(GroundFrame frame) {
  const bool x = frame.spacing_x > 0, y = frame.spacing_y > 0;
  if (!x) frame.spacing_x = y ? frame.spacing_y : kUnknownSpacing;
  if (!y) frame.spacing_y = frame.spacing_x;
  return frame;
}

/// Axis-aligned bounds of a terrain.
struct Bounds {
  std::array<double, 3> low{}, high{};
};

// skyAt() gives the colour of the sky in a row of a picture, which fills the pixels that show no
// ground.

/// The sky of a picture in R, G and B, from the top row to the bottom row.
inline std::array<uint32_t, 3> skyAt(uint32_t row, uint32_t rows) {
  constexpr std::array<uint32_t, 3> kZenith{172, 199, 226}, kHorizon{240, 243, 245};
  std::array<uint32_t, 3> sky{};
  for (size_t c = 0; c < 3; ++c) sky[c] = (kZenith[c] * (rows - row) + kHorizon[c] * row) / rows;
  return sky;
}

// A Camera is a pinhole camera that looks at the ground. Encoders take cameras as options, and
// renderers draw what they see.

/// A pinhole camera in the axes of GroundFrame (metres, y up). fov_y in degrees.
struct Camera {
  std::string name;
  std::array<double, 3> eye{}, target{}, up{0, 1, 0};
  double fov_y = 40;
  uint32_t width = 768, height = 512;
  double weight = 1;  ///< of its picture beside those of other cameras
};

/// TKS_USAGE with a sentence that names the camera and says what is wrong: a number that is not
/// finite, eye and target in one place, an up along the line of sight, an angle beyond (0, 180), a
/// picture of no pixel or more than 8192 a side, a negative weight.
Status checkCamera(const Camera& camera);

inline constexpr uint32_t kLargestPicture = 8192;  ///< pixels a side

// seeingAll() moves a camera, without turning it, to the nearest place from which it sees the whole
// box of a terrain.

/// The tangents of half the angles that a picture spans.
struct HalfAngles {
  double tan_x, tan_y;
};

inline Vec3 centreOf(const Bounds& bounds) {
  return scale(add(bounds.low, bounds.high), 0.5);
}

// presetCameras() makes cameras from the name of a view and the bounds of a terrain, so that a user
// needs no file of cameras.

/// Named view of a terrain, from the south, north up: "oblique" (sees all of it, 35 degrees above
/// the horizon), "low" (from just above the highest ground, sees about a tenth before the sky),
/// "top" (sees all of it, straight down). "all" gives the three, "orbit" the oblique view from four
/// sides, "any" those of unknownViewer(), "around" those of camerasAround(). Other names, or bounds
/// that are not finite: TKS_USAGE.
Result<std::vector<Camera>> presetCameras(const std::string& view, const Bounds& bounds);

/// A mix for a viewer of whom nothing is known: the oblique and the low view from four sides, which
/// count as one each, and the top view. Bounds that are not finite: TKS_USAGE.
Result<std::vector<Camera>> unknownViewer(const Bounds& bounds);

/// Views of an object of which nobody knows the upper side: from the six faces and the eight
/// corners of a cube around it, each of all of it. Bounds that are not finite: TKS_USAGE.
Result<std::vector<Camera>> camerasAround(const Bounds& bounds);

}  // namespace tetrakis::inline ground
