// SPDX-License-Identifier: Apache-2.0
// MeshColours takes the colours of a mesh's image to the patches of a forest: each texel has the
// colour of the place where its sample was cast, on the triangle that lies there, so that charts of
// the image that touch each other do not mix.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/remesh/cleaned_mesh.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

/// Values of 8 or 16 bits, row by row, `channels` for each texel.
struct MeshImage {
  uint32_t width = 0, height = 0, channels = 0;
  std::span<const uint8_t> bytes;  ///< one of the two is empty
  std::span<const uint16_t> shorts;
};

class MeshColours {
 public:
  /// texcoords: three pairs a triangle of the input, from 0 to 1 across the image, which repeats
  /// beyond. All outlive this.
  MeshColours(const CleanedMesh& mesh, std::span<const float> texcoords, const MeshImage& image)
      : mesh_(mesh), texcoords_(texcoords), image_(image) {}

  /// Texels of the image that the mesh shows.
  double shown() const;

  /// Of the same mesh under other texels, interleaved, of the same size; they outlive it.
  MeshColours withTexels(std::span<const uint16_t> texels) const {
    return {mesh_, texcoords_, {image_.width, image_.height, image_.channels, {}, texels}};
  }

  /// The colour at each place, bilinear between the middles of texels.
  std::vector<uint16_t> at(std::span<const SurfacePoint> places) const;

 private:
  std::array<double, 2> coordinates(const SurfacePoint& place) const;
  void sample(const std::array<double, 2>& at, uint16_t* out) const;
  double value(int64_t x, int64_t y, uint32_t channel) const;

  const CleanedMesh& mesh_;
  std::span<const float> texcoords_;
  MeshImage image_;
};

}  // namespace tetrakis::inline remesh
