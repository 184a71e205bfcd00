// SPDX-License-Identifier: Apache-2.0
#include "bench/meshes/screen.hpp"

#include <utility>

#include "apps/tools/report/viewed_mesh.hpp"
#include "codec/ground/camera.hpp"

namespace tetrakis::bench {

Result<Screen> Screen::create(const tools::Surface& surface, const GroundFrame& frame,
                              const tools::ImageFile& texture) {
  Screen screen(frame, texture);
  auto renderer = tools::Renderer::create();
  if (!renderer.ok()) return renderer.status();
  screen.renderer_ = std::move(*renderer);
  const Bounds bounds = tools::boundsOf(surface, frame);
  auto cameras = presetCameras("all", bounds), any = presetCameras("any", bounds);
  if (!cameras.ok()) return cameras.status();
  if (!any.ok()) return any.status();
  screen.cameras_ = std::move(*cameras);
  screen.any_ = std::move(*any);
  tools::MeshFile mesh = tools::fullGrid(surface, frame);
  mesh.texture = &texture;
  auto pictures = screen.renderer_->draw(mesh, screen.cameras_);
  if (!pictures.ok()) return pictures.status();
  screen.reference_ = std::move(*pictures);
  return screen;
}

std::vector<tks_screen_camera> Screen::told(const std::vector<Camera>& cameras) const {
  std::vector<tks_screen_camera> list;
  for (const Camera& camera : cameras) list.push_back(tools::meshCamera(camera, frame_));
  return list;
}

Result<std::vector<double>> Screen::score(tools::MeshFile mesh, const tools::ImageFile* texture) {
  mesh.texture = texture != nullptr ? texture : texture_;
  const auto pictures = renderer_->draw(mesh, cameras_);
  if (!pictures.ok()) return pictures.status();
  std::vector<double> psnr = {tools::screenPsnr(reference_, *pictures)};
  for (size_t i = 0; i < reference_.size(); ++i)
    psnr.push_back(tools::screenPsnr({reference_[i]}, {(*pictures)[i]}));
  return psnr;
}

tools::MeshFile placed(const PlanMesh& mesh, const GroundFrame& frame, double offset) {
  const double last_column = frame.width - 1.0, last_row = frame.height - 1.0;
  tools::MeshFile file;
  for (const auto& [x, y, z] : mesh.positions) {
    file.positions.push_back(static_cast<float>((x - last_column / 2) * frame.spacing_x));
    file.positions.push_back(static_cast<float>((z + offset) * frame.metres_per_unit));
    file.positions.push_back(static_cast<float>((y - last_row / 2) * frame.spacing_y));
    file.texcoords.push_back(static_cast<float>(x / last_column));
    file.texcoords.push_back(static_cast<float>(y / last_row));
  }
  file.triangles = mesh.triangles;
  return file;
}

}  // namespace tetrakis::bench
