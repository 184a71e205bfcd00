// SPDX-License-Identifier: Apache-2.0
// MeshColours looks up the colours of places of a mesh in the image of the mesh. Each texel of a
// forest's patch gets the colour of the place that its sample shows. The texture coordinates are
// those of the triangle at that place, so that charts of the image that touch do not mix.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/remesh/cleaned_mesh.hpp"
#include "codec/remesh/triangle_mesh.hpp"

namespace tetrakis::inline remesh {

/// Values of 8 or 16 bits, row by row, `channels` for each texel. Either `bytes` or `shorts` is
/// empty.
struct MeshImage {
  uint32_t width = 0, height = 0, channels = 0;
  std::span<const uint8_t> bytes;
  std::span<const uint16_t> shorts;
};

class MeshColours {
 public:
  /// texcoords: three pairs for each triangle of the input. They run from 0 to 1 across the image,
  /// which repeats beyond. The mesh and what the spans show outlive this.
  MeshColours(const CleanedMesh& mesh, std::span<const float> texcoords, const MeshImage& image)
      : mesh_(mesh), texcoords_(texcoords), image_(image) {}

  /// How many texels of the image the triangles of the mesh show, counted once for each triangle.
  double shown() const;

  /// Of the same mesh under other texels, interleaved, of the same size; they outlive it.
  MeshColours withTexels(std::span<const uint16_t> texels) const {
    return {mesh_, texcoords_, {image_.width, image_.height, image_.channels, {}, texels}};
  }

  /// The channels of each place, interpolated bilinearly between the centres of texels.
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
