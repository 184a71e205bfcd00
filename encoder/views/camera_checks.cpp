// SPDX-License-Identifier: Apache-2.0
#include "encoder/views/camera_checks.hpp"

#include <algorithm>
#include <vector>

#include "base/shown_text.hpp"
#include "codec/geometry/quantiser/voids.hpp"
#include "encoder/views/view_inputs.hpp"
#include "ratecontrol/pictures/screen_points.hpp"

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
  if (inputs.heights == nullptr) return {};
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

}  // namespace tetrakis::inline views
