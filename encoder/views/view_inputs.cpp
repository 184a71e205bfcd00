// SPDX-License-Identifier: Apache-2.0
#include "encoder/views/view_inputs.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/coordinates.hpp"
#include "base/samples.hpp"
#include "base/shown_text.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/ground/camera.hpp"
#include "ratecontrol/pictures/picture_errors.hpp"

namespace tetrakis::inline views {

namespace {

/// How many points of a picture are looked at: at first, and in the end about as many as
/// a picture of 768 x 512 has pixels; each time this many times as many as before. More points find
/// smaller pieces of ground before a camera is refused, and take time.
constexpr size_t kFewPoints = 1 << 10, kManyPoints = 1 << 19, kMorePoints = 8;

Status blames(const Camera& camera, const char* what) {
  return {TKS_USAGE, "Camera '" + shownText(camera.name) + "' " + what + "."};
}

/// The ground may fill so small a part of the picture that no point of a few falls on it.
bool seesNothing(const Camera& camera, const GroundRays& ground) {
  for (size_t count = kFewPoints; count <= kManyPoints; count *= kMorePoints) {
    const ScreenPoints points({camera}, count);
    if (points.blindCameras(points.seenOf(ground, {1, 1})).empty()) return false;
  }
  return true;
}

}  // namespace

Status checkCameras(const EncodeInputs& inputs) {
  const tks_encode_options& options = inputs.options;
  if (options.camera_count == 0) return {};
  const std::vector<Camera> cameras = givenCameras(options);
  for (const Camera& camera : cameras)
    if (Status status = checkCamera(camera); !status.ok()) return status;
  if (std::all_of(cameras.begin(), cameras.end(), [](const Camera& c) { return c.weight == 0; }))
    return {TKS_USAGE, "No camera has a weight above 0."};
  if (inputs.heights == nullptr || inputs.heights->domain == TKS_DOMAIN_FOREST) return {};
  if (inputs.heights->width < 2 || inputs.heights->height < 2)
    return {TKS_USAGE, "Heights of one column or row have no area that a camera could see."};
  const Result<std::vector<uint8_t>> valid = findVoids(*inputs.heights);
  if (!valid.ok()) return valid.status();
  const GroundRays ground(reliefOf(*inputs.heights, inputs.heights->data, *valid));
  for (const Camera& camera : cameras) {
    const auto height = ground.heightAt(camera.eye[0], camera.eye[2]);
    if (camera.eye[1] < height.value_or(ground.bounds().low[1]))
      return blames(camera, "is below the ground");
  }
  const ScreenPoints points(cameras, kViewPixels);
  for (const size_t i : points.blindCameras(points.seenOf(ground, {1, 1}))) {
    if (seesNothing(cameras[i], ground)) return blames(cameras[i], "sees no ground");
  }
  return {};
}

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
