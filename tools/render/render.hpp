// SPDX-License-Identifier: Apache-2.0
// Headless pictures of textured terrain: EGL without a surface, OpenGL ES 3 (Mesa, or a GPU).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/status.hpp"
#include "tools/files/files.hpp"

namespace tetrakis::tools {

/// A pinhole camera in the axes of MeshFile (metres, y up). fov_y in degrees.
struct Camera {
  std::string name;
  std::array<double, 3> eye{}, target{}, up{0, 1, 0};
  double fov_y = 40;
  uint32_t width = 768, height = 512;
};

/// Axis-aligned bounds of a terrain in the axes of MeshFile.
struct Bounds {
  std::array<double, 3> low{}, high{};
};

/// Named view of a terrain, from the south, north up: "oblique" (sees all of it, 35 degrees above
/// the horizon), "low" (from just above the highest ground, sees about a tenth before the sky),
/// "top" (sees all of it, straight down). "all" gives the three. Other names, or bounds that are
/// not finite: TKS_USAGE.
Result<std::vector<Camera>> presetCameras(const std::string& view, const Bounds& bounds);

/// Cameras from a JSON file: {"cameras": [{"name", "eye": [x,y,z], "target": [x,y,z], "up"?,
/// "fov_y"?, "width"?, "height"?}]}. Pictures have 1 to 8192 pixels a side, fov_y is in (0, 180).
/// TKS_IO: cannot be read; TKS_USAGE: says which camera and which field is wrong.
Result<std::vector<Camera>> readCameras(const std::string& path);

/// Mean over the cameras of cot(elevation) at the target: metres that a height error of one metre
/// appears to move along the ground (tks_encode_options::parallax). 0 for a view from the top; a
/// camera counts at most 20 (less than 3 degrees above the horizon). 0 without cameras.
double parallaxOf(const std::vector<Camera>& cameras);

/// RGBA8 picture, row by row from the top. RGB is the terrain before a pale sky, alpha how much of
/// the pixel the terrain covers: 0 where nothing was drawn.
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;
};

/// Owns one EGL context. Not thread safe; create and use it on one thread.
class Renderer {
 public:
  /// TKS_UNSUPPORTED if this machine has no EGL or no OpenGL ES 3 driver.
  static Result<std::unique_ptr<Renderer>> create();
  virtual ~Renderer() = default;

  /// Draws the mesh with its texture (trilinear, no light, clamped at the edges), or hill-shaded
  /// grey when it has none. Every pixel is the mean of 2 x 2 samples. 16-bit textures are reduced
  /// to 8 bits, textures beyond the driver's largest size by halving, texels of alpha below one
  /// half are holes. Triangles with a corner that is not finite are left out. Errors: TKS_USAGE
  /// (indices or texture coordinates do not fit the vertices), TKS_LIMIT (a picture too large for
  /// the driver), TKS_NO_MEMORY.
  virtual Result<std::vector<Picture>> draw(const MeshFile& mesh,
                                            const std::vector<Camera>& cameras) = 0;

  /// The same for one camera. Drawing several at once saves moving the mesh to the GPU each time.
  Result<Picture> draw(const MeshFile& mesh, const Camera& camera);
};

/// PSNR in dB between two sets of pictures of the same cameras: squared error over RGB of the
/// pixels that either picture covers, mean of the MSE over the pictures that show anything.
/// Infinity when equal; NaN when the sets differ in number or size.
double screenPsnr(const std::vector<Picture>& reference, const std::vector<Picture>& test);

}  // namespace tetrakis::tools
