// SPDX-License-Identifier: Apache-2.0
// PictureJudge is the rendered engine of screen distortion (thesis 6.1): it draws the pictures that
// decoders show and compares them with the original, for an encoder that asks
// (tks_encode_options.picture_error).
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/render/render.hpp"
#include "apps/tools/report/scene.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

class PictureJudge {
 public:
  /// heights, image: the originals, which outlive this. TKS_UNSUPPORTED without a renderer.
  static Result<PictureJudge> create(const HeightFile& heights, const ImageFile& image,
                                     std::vector<Camera> cameras);

  /// tks_picture_error; user: a judge.
  static int error(void* user, const void* heights, const void* texels, double* squares,
                   double* values);

  /// Pairs that have been asked about.
  size_t drawn() const { return drawn_; }

 private:
  PictureJudge(const HeightFile& heights, const ImageFile& image)
      : heights_(&heights), image_(&image) {}

  Result<std::vector<Picture>> draw(const HeightFile& heights, const ImageFile& image);

  const HeightFile* heights_;
  const ImageFile* image_;
  std::vector<Camera> cameras_;
  std::unique_ptr<Renderer> renderer_;
  std::vector<Picture> truth_;
  size_t drawn_ = 0;
};

}  // namespace tetrakis::tools
