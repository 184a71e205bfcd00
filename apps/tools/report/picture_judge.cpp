// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/report/picture_judge.hpp"

#include <cmath>
#include <cstring>
#include <utility>

namespace tetrakis::tools {

Result<PictureJudge> PictureJudge::create(const HeightFile& heights, const ImageFile& image,
                                          std::vector<Camera> cameras) {
  PictureJudge judge(heights, image);
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create();
  if (!renderer.ok()) return renderer.status();
  judge.renderer_ = std::move(*renderer);
  judge.cameras_ = std::move(cameras);
  Result<std::vector<Picture>> truth = judge.draw(heights, image);
  if (!truth.ok()) return truth.status();
  judge.truth_ = std::move(*truth);
  return judge;
}

Result<std::vector<Picture>> PictureJudge::draw(const HeightFile& heights, const ImageFile& image) {
  MeshFile mesh = fullGrid(heightsOf(heights), frameOf(heights));
  mesh.texture = &image;
  return renderer_->draw(mesh, cameras_);
}

int PictureJudge::error(void* user, const void* heights, const void* texels, double* squares,
                        double* values) {
  auto& judge = *static_cast<PictureJudge*>(user);
  ++judge.drawn_;
  HeightFile surface = *judge.heights_;
  std::memcpy(surface.data.data(), heights, surface.data.size());
  ImageFile texture = *judge.image_;
  std::memcpy(texture.data.data(), texels, texture.data.size());
  const Result<std::vector<Picture>> pictures = judge.draw(surface, texture);
  if (!pictures.ok()) return 1;
  *squares = *values = 0;
  for (size_t i = 0; i < pictures->size(); ++i) {
    const double psnr = screenPsnr({judge.truth_[i]}, {(*pictures)[i]});
    if (std::isnan(psnr)) continue;
    *squares += judge.cameras_[i].weight * 255 * 255 * std::pow(10, -psnr / 10);
    *values += judge.cameras_[i].weight;
  }
  return *values > 0 ? 0 : 1;
}

}  // namespace tetrakis::tools
