// SPDX-License-Identifier: Apache-2.0
// ObjectPictures takes a mesh with its image and returns how far streams of it are off in the
// pictures of cameras, whatever kind of object they hold.
#pragma once

#include <cstdint>
#include <vector>

#include "api/object_inputs.hpp"
#include "ratecontrol/pictures/picture_point.hpp"
#include "ratecontrol/pictures/triangle_pictures.hpp"

namespace tetrakis::inline api {

class ObjectPictures {
 public:
  /// given: has an image, and outlives this. Its cameras look, or, if it has none, cameras all
  /// around the mesh. TKS_USAGE with a sentence that names a camera which can see nothing.
  static Result<ObjectPictures> of(const GivenObject& given);

  /// Mean squared error of R, G and B where a picture shows the mesh or the object. The stream is
  /// an object with a texture.
  Result<double> errorOf(const std::vector<uint8_t>& stream) const;

 private:
  explicit ObjectPictures(std::vector<Camera> cameras) : pictures_(std::move(cameras)) {}

  TrianglePictures pictures_;
  std::vector<SeenTriangle> seen_;  ///< of the mesh
  std::vector<Colour> colours_;
};

}  // namespace tetrakis::inline api
