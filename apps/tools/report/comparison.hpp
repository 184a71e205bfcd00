// SPDX-License-Identifier: Apache-2.0
// Comparer measures how far a stream, or a prefix of it, is from the input: in the samples and on
// the screen (thesis, section 6.1: distortion is measured between rendered pictures).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/render/render.hpp"
#include "apps/tools/report/camera_choice.hpp"
#include "apps/tools/report/scene.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// What was encoded. At least one is present.
struct Reference {
  std::optional<HeightFile> heights;
  std::optional<ImageFile> image;
};

/// Infinity in a PSNR: exact. Absent: not applicable.
struct HeightErrors {
  double rmse = 0, max_error = 0;  ///< in the unit of the stream
  double psnr = 0;                 ///< dB; the peak is the range of the reference's heights
  double rounding = 0;             ///< how far off max_error may be, as heights are doubles
};

struct Measurement {
  uint64_t bytes = 0, geometry_bytes = 0, texture_bytes = 0;
  std::optional<uint32_t> triangles;  ///< of the mesh that was drawn
  std::optional<HeightErrors> heights;
  std::optional<double> texture_psnr;  ///< dB over all channels that count (tks_image)
  std::optional<double> screen_psnr;   ///< dB over all cameras, by their weights
  std::vector<double> camera_psnr;     ///< dB, one a camera; empty without a renderer
  std::vector<Picture> pictures;       ///< one a camera
};

/// Measures prefixes of one stream against one reference, which must outlive it. Move only.
class Comparer {
 public:
  /// Takes scale, offset, spacing and unit from the stream `header` (any prefix that opens), so the
  /// reference is read as the encoder read it. TKS_MISMATCH if sizes or types differ, TKS_USAGE if
  /// the stream lacks what the reference has.
  static Result<Comparer> create(const Reference& reference, const tks_info& header);

  /// Draws the reference with these cameras; from then on measure() draws too. Errors: of the
  /// renderer, of the camera file; TKS_USAGE if no camera has a weight above 0.
  Status look(const CameraChoice& choice);

  /// triangles 0: the surface itself, drawn as its full grid; otherwise the mesh that a receiver
  /// makes of the stream, whose linear interpolation at every sample then counts for the height
  /// errors: for the cameras of look() and with the stream's texture, or, where none were chosen,
  /// the budget mesh.
  Result<Measurement> measure(Decoder& decoder, uint32_t triangles);
  Result<Measurement> measure(std::span<const uint8_t> stream, uint32_t triangles);

  /// What is drawn of heights does not depend on the texture, as that of a mesh for cameras does.
  bool drawsApart(uint32_t triangles) const { return triangles == 0 || choice_.isDefault(); }

  /// Textures for psnrWithEach(), in the place of those before. look() has been called.
  Status takeTextures(std::span<const ImageFile> textures) {
    return renderer_->takeTextures(textures);
  }

  /// Screen PSNR of the heights of a stream with each of these textures, and nothing else of what
  /// measure() says. drawsApart(triangles).
  Result<std::vector<double>> psnrWithEach(Decoder& stream, uint32_t triangles);

  const std::vector<Camera>& cameras() const { return cameras_; }
  const std::vector<Picture>& referencePictures() const { return pictures_; }

 private:
  explicit Comparer(const Reference& reference) : reference_(&reference) {}

  Result<MeshFile> measureSurface(Decoder& decoder, Measurement& result) const;
  Result<MeshFile> measureMesh(Decoder& decoder, uint32_t triangles, const ImageFile* texture,
                               Measurement& result) const;
  std::vector<double> weights() const;
  Status drawAndScore(MeshFile& mesh, const ImageFile* texture, Measurement& result);

  const Reference* reference_;
  PlacedFrame frame_;
  Surface surface_;  ///< reference heights in the unit of the stream, or a flat 2 x 2 stand-in
  std::unique_ptr<Renderer> renderer_;
  CameraChoice choice_;
  std::vector<Camera> cameras_;
  std::vector<Picture> pictures_;
};

}  // namespace tetrakis::tools
