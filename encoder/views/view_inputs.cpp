// SPDX-License-Identifier: Apache-2.0
#include "encoder/views/view_inputs.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "base/length_unit.hpp"
#include "base/samples.hpp"
#include "codec/ground/preset_cameras.hpp"

namespace tetrakis::inline views {

namespace {

std::string nameOf(const tks_camera& camera, uint32_t index) {
  const std::string number = std::to_string(index + 1);
  return camera.name != nullptr && *camera.name != 0 ? camera.name : number;
}

double metresIn(const char* unit) {
  return unit != nullptr ? metresPerUnit(unit).value_or(1) : 1;
}

}  // namespace

GroundFrame frameOf(const tks_heights& heights) {
  return knownFrame({heights.width, heights.height, heights.spacing_x, heights.spacing_y,
                     metresIn(heights.unit)});
}

Relief reliefOf(const tks_heights& like, const void* samples, const std::vector<uint8_t>& valid) {
  Relief relief{frameOf(like), {}};
  const double metres = relief.frame.metres_per_unit;
  relief.heights.resize(size_t{like.width} * like.height);
  withSampleType(like.sample, [&](auto type) {
    const auto* from = static_cast<const decltype(type)*>(samples);
    for (size_t i = 0; i < relief.heights.size(); ++i) {
      const double height = static_cast<double>(from[i]) * like.scale + like.offset;
      const bool is_void = !valid.empty() && !valid[i];
      relief.heights[i] =
          is_void ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(height * metres);
    }
  });
  return relief;
}

std::vector<Camera> givenCameras(const tks_encode_options& options) {
  std::vector<Camera> cameras;
  for (uint32_t i = 0; i < options.camera_count; ++i) {
    const tks_camera& given = options.cameras[i];
    Camera camera;
    camera.name = nameOf(given, i);
    std::copy_n(given.eye, 3, camera.eye.begin());
    std::copy_n(given.target, 3, camera.target.begin());
    std::copy_n(given.up, 3, camera.up.begin());
    camera.fov_y = given.fov_y;
    camera.width = given.width;
    camera.height = given.height;
    camera.weight = given.weight;
    cameras.push_back(std::move(camera));
  }
  return cameras;
}

std::vector<Camera> camerasOf(const tks_encode_options& options, const Bounds& bounds) {
  if (options.camera_count > 0) return givenCameras(options);
  const Result<std::vector<Camera>> cameras = unknownViewer(bounds);
  return cameras.ok() ? *cameras : std::vector<Camera>();
}

}  // namespace tetrakis::inline views
