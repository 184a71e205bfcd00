// SPDX-License-Identifier: Apache-2.0
// A Camera is a pinhole camera that looks at the ground. Encoders take cameras as options, and
// renderers draw what they see.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/status.hpp"
#include "codec/ground/frame.hpp"

namespace tetrakis::inline ground {

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

}  // namespace tetrakis::inline ground
