// SPDX-License-Identifier: Apache-2.0
// From cameras in metres to views of the sample grid; see viewed_mesh.hpp.
#include "apps/tools/report/viewed_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "apps/tools/files/stream.hpp"
#include "codec/ground/camera.hpp"

namespace tetrakis::tools {

Result<std::vector<Camera>> camerasOver(Decoder& decoder, const CameraChoice& choice) {
  Result<std::vector<float>> heights = decoder.surface();
  if (!heights) return heights.status();
  const tks_info& info = decoder.info();
  const Surface surface{info.width, info.height, {heights->begin(), heights->end()}};
  return chooseCameras(choice, boundsOf(surface, frameOf(info)));
}

namespace {

Status seesNothing(const Camera& camera) {
  return Status(TKS_USAGE, "the camera '" + camera.name + "' sees no ground");
}

/// A few triangles tell: trees give all that a camera may see.
Status checkSight(Decoder& decoder, const std::vector<Camera>& cameras) {
  constexpr uint32_t kTriangles = 1000;
  const Result<MeshTree> tree = decoder.budgetMeshTree(kTriangles);
  if (!tree) return tree.status();
  for (const Camera& camera : cameras) {
    const Result<Mesh> seen = tree->view(clipOf(camera, frameOf(decoder.info())));
    if (!seen) return seen.status();
    if (seen->triangleCount() == 0) return seesNothing(camera);
  }
  return Status();
}

}  // namespace

std::array<double, 16> clipOf(const Camera& camera, const PlacedFrame& frame) {
  const ViewAxes axes = viewAxes(camera.eye, camera.target, camera.up);
  const double tan_y = std::tan(camera.fov_y * std::numbers::pi / 360);
  const double tan_x = tan_y * camera.width / camera.height;
  const double left = (frame.width - 1.0) / 2 * frame.spacing_x;
  const double back = (frame.height - 1.0) / 2 * frame.spacing_y;
  const Vec3 rows[4] = {scale(axes.right, 1 / tan_x), scale(axes.up, 1 / tan_y), {}, axes.forward};
  std::array<double, 16> clip;
  for (size_t i = 0; i < 4; ++i) {
    const auto& [east, y, south] = rows[i];
    const double x = east * frame.axes.along[0] + south * frame.axes.along[1];
    const double z = east * frame.axes.down[0] + south * frame.axes.down[1];
    clip[4 * i] = x * frame.spacing_x;
    clip[4 * i + 1] = z * frame.spacing_y;
    clip[4 * i + 2] = y * frame.metres_per_unit;
    clip[4 * i + 3] = -dot(rows[i], camera.eye) - x * left - z * back;
  }
  return clip;
}

Result<Mesh> viewedMesh(Decoder& decoder, bool coded, const CameraChoice& choice) {
  const Result<std::vector<Camera>> cameras = camerasOver(decoder, choice);
  if (!cameras.ok()) return cameras.status();
  if (cameras->size() != 1)
    return Status(TKS_USAGE, "a mesh is cut to the view of one camera, not of " +
                                 std::to_string(cameras->size()));
  const Camera& camera = cameras->front();
  const Result<MeshTree> tree = coded ? decoder.codedMeshTree() : decoder.budgetMeshTree(0);
  if (!tree) return tree.status();
  Result<Mesh> mesh = tree->view(clipOf(camera, frameOf(decoder.info())));
  if (!mesh) return mesh.status();
  if (mesh->triangleCount() == 0) return seesNothing(camera);
  return std::move(*mesh);
}

tks_screen_camera meshCamera(const Camera& camera, const PlacedFrame& frame) {
  tks_screen_camera result = makeScreenCamera();
  result.width = camera.width;
  result.height = camera.height;
  result.weight = camera.weight;
  const std::array<double, 16> clip = clipOf(camera, frame);
  std::copy(clip.begin(), clip.end(), result.clip);
  return result;
}

Result<std::vector<tks_screen_camera>> meshCameras(Decoder& decoder, const CameraChoice& choice) {
  const Result<std::vector<Camera>> chosen = camerasOver(decoder, choice);
  if (!chosen.ok()) return chosen.status();
  const bool placed = choice.view != "any";  // by somebody, so that it should see something
  if (const Status seen = placed ? checkSight(decoder, *chosen) : Status(); !seen.ok()) return seen;
  std::vector<tks_screen_camera> cameras;
  for (const Camera& camera : *chosen)
    if (camera.weight > 0) cameras.push_back(meshCamera(camera, frameOf(decoder.info())));
  if (cameras.empty()) return Status(TKS_USAGE, "no camera has a weight above 0");
  return cameras;
}

Result<Mesh> meshForCameras(Decoder& decoder, uint32_t triangles, const CameraChoice& choice,
                            const ImageFile* texture) {
  std::vector<tks_screen_camera> cameras;
  if (!choice.isDefault()) {
    Result<std::vector<tks_screen_camera>> chosen = meshCameras(decoder, choice);
    if (!chosen.ok()) return chosen.status();
    cameras = *std::move(chosen);
  }
  const tks_image image = texture != nullptr ? asImage(*texture) : tks_image();
  return decoder.screenMesh(cameras, triangles, texture != nullptr ? &image : nullptr);
}

}  // namespace tetrakis::tools
