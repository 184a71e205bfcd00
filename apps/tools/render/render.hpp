// SPDX-License-Identifier: Apache-2.0
// Renderer draws pictures of textured terrain without a screen: EGL without a surface, OpenGL ES 3
// (Mesa, or a GPU).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "codec/ground/camera.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::tools {

/// Cameras from a JSON file: {"cameras": [{"name", "eye": [x,y,z], "target": [x,y,z], "up"?,
/// "fov_y"?, "width"?, "height"?, "weight"?}]}, as checkCamera() takes them.
/// TKS_IO: cannot be read; TKS_USAGE: says which camera and what is wrong.
Result<std::vector<Camera>> readCameras(const std::string& path);

/// RGBA8 picture, row by row from the top. RGB is the terrain before a pale sky, alpha how much of
/// the pixel the terrain covers: 0 where nothing was drawn.
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;
};

/// The terrain before its sky, without the alpha.
ImageFile imageOf(const Picture& picture);

/// Owns one EGL context. Not thread safe; create and use it on one thread.
class Renderer {
 public:
  /// TKS_UNSUPPORTED if this machine has no EGL or no OpenGL ES 3 driver.
  static Result<std::unique_ptr<Renderer>> create();
  virtual ~Renderer() = default;

  /// Draws the mesh with its texture (trilinear, no light, edges as the mesh says), or hill-shaded
  /// grey when it has none. Every pixel is the mean of 2 x 2 samples. 16-bit textures are reduced
  /// to 8 bits, textures beyond the driver's largest size by halving, texels of alpha below one
  /// half are holes. Triangles with a corner that is not finite are left out. Errors: TKS_USAGE
  /// (indices or texture coordinates do not fit the vertices), TKS_LIMIT (a picture too large for
  /// the driver), TKS_NO_MEMORY.
  virtual Result<std::vector<Picture>> draw(const MeshFile& mesh,
                                            const std::vector<Camera>& cameras) = 0;

  /// Textures for drawWithEach(), in the place of those before; they stay on the GPU.
  virtual Status takeTextures(std::span<const ImageFile> textures) = 0;

  /// The same for a mesh with texture coordinates and no texture, with one of these textures after
  /// the other: the mesh moves to the GPU once. take: called with the pictures of each.
  using TakePictures = std::function<void(std::vector<Picture> pictures)>;
  virtual Status drawWithEach(const MeshFile& mesh, const std::vector<Camera>& cameras,
                              const TakePictures& take) = 0;

  /// The same for one camera. Drawing several at once saves moving the mesh to the GPU each time.
  Result<Picture> draw(const MeshFile& mesh, const Camera& camera);
};

/// PSNR in dB between two sets of pictures of the same cameras: squared error over RGB of the
/// pixels that either picture covers, mean of the MSE over the pictures that show anything.
/// weights: of the pictures in that mean, one each, none negative; empty: all alike. Infinity when
/// what counts is equal; NaN when the sets differ in number or size.
double screenPsnr(const std::vector<Picture>& reference, const std::vector<Picture>& test,
                  const std::vector<double>& weights = {});

}  // namespace tetrakis::tools
