// SPDX-License-Identifier: Apache-2.0
// Meshes for cameras through the C interface.
#include "codec/mesh/meshes.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "api/guarded.hpp"
#include "api/memory.hpp"
#include "api/outlook.hpp"
#include "api/written.hpp"
#include "base/samples.hpp"
#include "codec/mesh/screen/surface_picture.hpp"

namespace tetrakis::inline api {
namespace {

/// The cameras for heights in steps.
std::vector<ScreenView> viewsOf(const std::vector<tks_screen_camera>& cameras,
                                const SurfaceScale& scale) {
  std::vector<ScreenView> views;
  for (const tks_screen_camera& camera : cameras) {
    ScreenView view{camera.width, camera.height, {}, weightOf(camera)};
    std::copy_n(camera.clip, 16, view.clip.begin());
    for (size_t row = 0; row < 4; ++row) {
      view.clip[4 * row + 3] += view.clip[4 * row + 2] * scale.offset;
      view.clip[4 * row + 2] *= scale.scale;
    }
    views.push_back(view);
  }
  return views;
}

Status takeTexture(const tks_image& given, tks_image& out) {
  Status status = takeSized("the texture", given, offsetof(tks_image, geotransform), out);
  if (!status.ok()) return status;
  if (out.data == nullptr || out.width == 0 || out.height == 0)
    return {TKS_USAGE, "The texture has no samples."};
  constexpr uint32_t kMostTexels = 32768;
  if (out.width > kMostTexels || out.height > kMostTexels)
    return {TKS_USAGE,
            "A texture has sides of at most " + std::to_string(kMostTexels) + " texels."};
  if (out.channels < 1 || out.channels > 4 || (out.sample != TKS_U8 && out.sample != TKS_U16))
    return {TKS_USAGE, "A texture has 1 to 4 channels of 8 or 16 bits a sample."};
  if (out.white_level > largestTexel(out.sample))
    return {TKS_USAGE, "The white level of a texture is none of its values."};
  return {};
}

/// How bright each texel is, in 8 bits. The image has a white level.
GroundImage brightnessOf(const tks_image& image) {
  GroundImage brightness;
  withSampleType(image.sample, [&](auto type) {
    using Sample = decltype(type);
    const auto* samples = static_cast<const Sample*>(image.data);
    const auto sample = [&](size_t i) {
      return shownIn8Bits(static_cast<uint32_t>(samples[i]), image.white_level);
    };
    brightness = GroundImage::of(image.width, image.height, image.channels, sample);
  });
  return brightness;
}

class ScreenMeshCall {
 public:
  ScreenMeshCall(tks_decoder& decoder, uint32_t max_triangles)
      : decoder_(decoder), max_triangles_(max_triangles) {}

  Status run(const tks_screen* given, tks_mesh& out) {
    const StreamHeader& header = decoder_.parsed.header;
    if (!header.geometry) return noHeights();
    if (header.geometry->wavelet.forest != nullptr) return noMesh();
    if (max_triangles_ == 0) return {TKS_USAGE, "A mesh for the screen takes a triangle or more."};
    if (decoder_.heights_level > 0)
      return {TKS_USAGE, "Meshes are made of the heights of level 0; ask for few triangles."};
    const Result<Lattice> lattice =
        Lattice::make(header.geometry->shown().width, header.geometry->shown().height);
    if (!lattice.ok()) return lattice.status();
    tks_screen screen{};
    if (given != nullptr) {
      const Status status = takeSized("the screen", *given, sizeof given->size, screen);
      if (!status.ok()) return status;
    }
    const auto cameras = takeCameras(screen.cameras, screen.camera_count);
    if (!cameras.ok()) return cameras.status();
    if (Status status = refuseGlobes("A mesh for the screen", *cameras); !status.ok())
      return status;
    tks_image texture{};
    if (screen.texture != nullptr) {
      if (Status status = takeTexture(*screen.texture, texture); !status.ok()) return status;
      if (texture.white_level == 0) texture.white_level = whiteLevelBeside(texture.sample);
    }
    return make(*lattice, *cameras, texture, out);
  }

 private:
  /// That of the stream's texture, if its samples are of this type.
  uint32_t whiteLevelBeside(tks_sample sample) const {
    const auto& texture = decoder_.parsed.header.texture;
    return texture && texture->sample == sample ? texture->white() : largestTexel(sample);
  }

  /// texture: without data if there is none.
  Status make(const Lattice& lattice, const std::vector<tks_screen_camera>& cameras,
              const tks_image& texture, tks_mesh& out) {
    if (Status status = checkSize(lattice, texture, max_triangles_); !status.ok()) return status;
    const Result<const DecodedGeometry*> geometry = decodedGeometry(decoder_);
    if (!geometry.ok()) return geometry.status();
    const SurfaceScale scale = surfaceScale(decoder_.parsed.header, **geometry);
    const std::vector<ScreenView> views = viewsOf(cameras, scale);
    WeightedSurface surface{{lattice.width(), lattice.height(), (*geometry)->heights},
                            (*geometry)->valid};
    std::vector<float> weights;
    if (!views.empty()) {
      const GroundImage image = texture.data == nullptr ? GroundImage() : brightnessOf(texture);
      weights = screenWeights(surface, views, image);
      surface.view.weights = weights;
    }
    const auto admits = [&](uint64_t triangles) { return checkSize(lattice, texture, triangles); };
    Result<FittedMesh> mesh = screenMesh(lattice, surface, max_triangles_, admits);
    if (!mesh.ok()) return mesh.status();
    std::vector<float> heights = heightsInUnit(mesh->mesh, (*geometry)->valid, scale,
                                               [&](size_t v) { return mesh->heights[v]; });
    leaveOutVoids(mesh->mesh, heights);
    copyMesh(mesh->mesh, heights, out);
    return {};
  }

  Status checkSize(const Lattice& lattice, const tks_image& texture, uint64_t triangles) const {
    const uint64_t texels = texture.data == nullptr ? 0 : uint64_t{texture.width} * texture.height;
    return checkBytes(decoder_, {TKS_PART_BUDGET_MESH, {}, max_triangles_},
                      screenMeshBytes(decoder_, lattice, triangles, texels));
  }

  tks_decoder& decoder_;
  uint32_t max_triangles_;
};

}  // namespace
}  // namespace tetrakis::inline api

tks_status tks_decode_screen_mesh(tks_decoder* decoder, const tks_screen* screen,
                                  uint32_t max_triangles, tks_mesh* out) {
  if (out == nullptr) return tetrakis::keeping(decoder, tetrakis::outputMissing);
  if (decoder == nullptr) return TKS_USAGE;
  *out = {};
  const tks_status status = tetrakis::keeping(
      decoder, [&] { return tetrakis::ScreenMeshCall(*decoder, max_triangles).run(screen, *out); });
  if (status != TKS_OK) tks_free_mesh(out);
  return status;
}
