// SPDX-License-Identifier: Apache-2.0
// From cameras in metres to views of the sample grid; see viewed_mesh.hpp.
#include "apps/tools/report/viewed_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
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

namespace {

/// Of clip coordinates, by which each takes a way from the eye.
std::array<Vec3, 4> rowsOf(const Camera& camera) {
  const ViewAxes axes = viewAxes(camera.eye, camera.target, camera.up);
  const double tan_y = std::tan(camera.fov_y * std::numbers::pi / 360);
  const double tan_x = tan_y * camera.width / camera.height;
  return {scale(axes.right, 1 / tan_x), scale(axes.up, 1 / tan_y), {}, axes.forward};
}

}  // namespace

std::array<double, 16> clipOf(const Camera& camera, const PlacedFrame& frame) {
  const double left = (frame.width - 1.0) / 2 * frame.spacing_x;
  const double back = (frame.height - 1.0) / 2 * frame.spacing_y;
  const std::array<Vec3, 4> rows = rowsOf(camera);
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

namespace {

tks_screen_camera screenCamera(const Camera& camera, const std::array<double, 16>& clip) {
  tks_screen_camera result = makeScreenCamera();
  result.width = camera.width;
  result.height = camera.height;
  result.weight = camera.weight;
  std::copy(clip.begin(), clip.end(), result.clip);
  return result;
}

/// From metres whose z points to the north pole, where those of the camera have y.
std::array<double, 16> globeClipOf(const Camera& camera) {
  const std::array<Vec3, 4> rows = rowsOf(camera);
  std::array<double, 16> clip;
  for (size_t i = 0; i < 4; ++i) {
    const auto& [x, y, z] = rows[i];
    const Vec3 row = {x, -z, y};
    std::copy(row.begin(), row.end(), clip.begin() + 4 * static_cast<std::ptrdiff_t>(i));
    clip[4 * i + 3] = -dot(rows[i], camera.eye);
  }
  return clip;
}

/// Whether a vertex of a globe is in the picture, on the side that faces the camera.
bool seesAny(const Camera& camera, const GlobeMesh& mesh) {
  const std::array<Vec3, 4> rows = rowsOf(camera);
  const std::span<const double> at = mesh.positions();
  for (size_t i = 0; i < at.size(); i += 3) {
    const Vec3 place = {at[i], at[i + 2], -at[i + 1]}, way = subtract(place, camera.eye);
    const double w = dot(rows[3], way);
    if (std::abs(dot(rows[0], way)) <= w && std::abs(dot(rows[1], way)) <= w && dot(place, way) < 0)
      return true;
  }
  return false;
}

Result<std::vector<tks_screen_camera>> weighted(std::vector<tks_screen_camera> cameras) {
  std::erase_if(cameras, [](const tks_screen_camera& camera) { return !(camera.weight > 0); });
  if (cameras.empty()) return Status(TKS_USAGE, "no camera has a weight above 0");
  return cameras;
}

}  // namespace

tks_screen_camera meshCamera(const Camera& camera, const PlacedFrame& frame) {
  return screenCamera(camera, clipOf(camera, frame));
}

Result<std::vector<tks_screen_camera>> globeCameras(Decoder& decoder, const CameraChoice& choice,
                                                    const tks_globe& globe) {
  constexpr uint32_t kTriangles = 10'000;
  if (choice.file.empty())
    return Status(TKS_USAGE, "presets look at flat ground: give the --cameras of a globe");
  const Result<std::vector<Camera>> chosen = readCameras(choice.file);
  if (!chosen.ok()) return chosen.status();
  const Result<GlobeMesh> mesh = decoder.budgetGlobe(globe, kTriangles);
  if (!mesh) return mesh.status();
  std::vector<tks_screen_camera> cameras;
  for (const Camera& camera : *chosen) {
    if (!seesAny(camera, *mesh)) return seesNothing(camera);
    cameras.push_back(screenCamera(camera, globeClipOf(camera)));
    cameras.back().globe = &globe;
  }
  return weighted(std::move(cameras));
}

Result<std::vector<tks_screen_camera>> meshCameras(Decoder& decoder, const CameraChoice& choice) {
  const Result<std::vector<Camera>> chosen = camerasOver(decoder, choice);
  if (!chosen.ok()) return chosen.status();
  const bool placed = choice.view != "any";  // by somebody, so that it should see something
  if (const Status seen = placed ? checkSight(decoder, *chosen) : Status(); !seen.ok()) return seen;
  std::vector<tks_screen_camera> cameras;
  for (const Camera& camera : *chosen)
    cameras.push_back(meshCamera(camera, frameOf(decoder.info())));
  return weighted(std::move(cameras));
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
