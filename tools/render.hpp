// SPDX-License-Identifier: Apache-2.0
// Headless pictures of textured terrain: EGL without a surface, OpenGL ES 3 (Mesa, or a GPU).
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "tools/files.hpp"

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

/// Named view of a terrain: "oblique" (sees all of it), "low" (from just above the ground, sees about
/// a tenth), "top". "all" gives the three.
Result<std::vector<Camera>> presetCameras(const std::string& view, const Bounds& bounds);

/// Cameras from a JSON file: {"cameras": [{"name", "eye": [x,y,z], "target": [x,y,z], "up"?, "fov_y"?,
/// "width"?, "height"?}]}.
Result<std::vector<Camera>> readCameras(const std::string& path);

/// Mean over the cameras of cot(elevation): metres that a height error of one metre appears to move
/// along the ground (tks_encode_options::parallax).
double parallaxOf(const std::vector<Camera>& cameras);

/// RGBA8 picture; alpha 0 where nothing was drawn.
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;
};

/// Owns one EGL context. Not thread safe; create and use it on one thread.
class Renderer {
 public:
  static Result<std::unique_ptr<Renderer>> create();
  virtual ~Renderer() = default;
  /// Draws the mesh with its texture (trilinear), or hill-shaded grey when it has none.
  virtual Result<Picture> draw(const MeshFile& mesh, const Camera& camera) = 0;
};

/// PSNR in dB between two sets of pictures: squared error over RGB of the pixels that either picture
/// covers, mean of the MSE over the pictures. Infinity when equal.
double screenPsnr(const std::vector<Picture>& reference, const std::vector<Picture>& test);

}  // namespace tetrakis::tools
