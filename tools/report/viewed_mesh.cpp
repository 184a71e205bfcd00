// SPDX-License-Identifier: Apache-2.0
// From cameras in metres to views of the sample grid; see viewed_mesh.hpp.
#include "tools/report/viewed_mesh.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "ground/vec3.hpp"
#include "tools/files/stream.hpp"

namespace tetrakis::tools {
namespace {

Result<Camera> chooseCamera(Decoder& decoder, const CameraChoice& choice) {
  Result<std::vector<float>> heights = decoder.surface();
  if (!heights) return heights.status();
  const tks_info& info = decoder.info();
  const Surface surface{info.width, info.height, {heights->begin(), heights->end()}};
  Result<std::vector<Camera>> cameras = chooseCameras(choice, boundsOf(surface, frameOf(info)));
  if (!cameras.ok()) return cameras.status();
  if (cameras->size() != 1)
    return Status(TKS_USAGE, "a mesh is cut to the view of one camera, not of " +
                                 std::to_string(cameras->size()));
  return std::move(cameras->front());
}

}  // namespace

std::array<double, 16> clipOf(const Camera& camera, const GroundFrame& frame) {
  const ViewAxes axes = viewAxes(camera.eye, camera.target, camera.up);
  const double tan_y = std::tan(camera.fov_y * std::numbers::pi / 360);
  const double tan_x = tan_y * camera.width / camera.height;
  const double left = (frame.width - 1.0) / 2 * frame.spacing_x;
  const double back = (frame.height - 1.0) / 2 * frame.spacing_y;
  const Vec3 rows[4] = {scale(axes.right, 1 / tan_x), scale(axes.up, 1 / tan_y), {}, axes.forward};
  std::array<double, 16> clip;
  for (size_t i = 0; i < 4; ++i) {
    const auto& [x, y, z] = rows[i];
    clip[4 * i] = x * frame.spacing_x;
    clip[4 * i + 1] = z * frame.spacing_y;
    clip[4 * i + 2] = y * frame.metres_per_unit;
    clip[4 * i + 3] = -dot(rows[i], camera.eye) - x * left - z * back;
  }
  return clip;
}

Result<Mesh> viewedMesh(Decoder& decoder, bool coded, uint32_t triangles,
                        const CameraChoice& choice) {
  const Result<Camera> camera = chooseCamera(decoder, choice);
  if (!camera.ok()) return camera.status();
  const Result<MeshTree> tree = coded ? decoder.codedMeshTree() : decoder.budgetMeshTree(triangles);
  if (!tree) return tree.status();
  Result<Mesh> mesh = tree->view(clipOf(*camera, frameOf(decoder.info())));
  if (!mesh) return mesh.status();
  if (mesh->triangleCount() == 0)
    return Status(TKS_USAGE, "the camera '" + camera->name + "' sees no ground");
  return std::move(*mesh);
}

}  // namespace tetrakis::tools
