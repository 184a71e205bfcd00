// SPDX-License-Identifier: Apache-2.0
// From samples and 4-8 meshes to scenes: surfaces, ground frames, meshes placed in metres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ground/frame.hpp"
#include "tetrakis/tetrakis.hpp"
#include "tools/files/files.hpp"
#include "tools/files/place/ground_axes.hpp"
#include "tools/render/render.hpp"

namespace tetrakis::tools {

/// width * height values, row by row.
struct Surface {
  uint32_t width = 0, height = 0;
  std::vector<double> values;
};

/// A frame that also knows which way the raster lies: x is east and z is south whatever way its
/// rows and columns run.
struct PlacedFrame : GroundFrame {
  PlacedFrame() = default;
  PlacedFrame(const GroundFrame& frame) : GroundFrame(frame) {}
  PlacedFrame(const GroundFrame& frame, const GroundAxes& lies) : GroundFrame(frame), axes(lies) {}

  GroundAxes axes;
};

/// The frame of a height field (knownFrame()); a unit that is no length counts as metres, and a
/// raster without a geotransform begins in the north-west.
PlacedFrame frameOf(const HeightFile& heights);
PlacedFrame frameOf(const tks_info& info);

/// The frame of a texture without heights: a flat rectangle of one metre a texel, 2 x 2 samples.
PlacedFrame frameOf(const ImageFile& image);

/// `width` x `height` samples of any type as doubles, exactly.
Surface samplesOf(uint32_t width, uint32_t height, tks_sample sample,
                  std::span<const std::byte> data);

/// Heights in `unit`: sample * scale + offset; NaN where the sample is NaN or the file's nodata.
Surface heightsOf(const HeightFile& file);

/// The mesh's linear interpolant at every sample of the grid that it covers; barycentric weights
/// are exact integers. NaN where no triangle is: meshes cover the grid but for voids and their
/// coasts.
Surface rasterize(const Mesh& mesh, uint32_t width, uint32_t height);

/// Every sample a vertex, every cell two triangles with the diagonals of the tetrakis tiling, but
/// for triangles that touch a void (NaN).
MeshFile fullGrid(const Surface& heights, const PlacedFrame& frame);

/// A decoded mesh in space, texture coordinates (column / (width - 1), row / (height - 1)).
MeshFile placeMesh(const Mesh& mesh, const PlacedFrame& frame);

/// Bounds of the placed surface, voids left out.
Bounds boundsOf(const Surface& heights, const PlacedFrame& frame);

/// The cameras of --cameras FILE or --view NAME; both empty: the oblique view.
struct CameraChoice {
  std::string file;
  std::string view;
  bool isDefault() const { return file.empty() && view.empty(); }
};
/// As encoders are told of them, whose x runs along rows and z down columns: exactly, where these
/// are perpendicular. The names are those of `cameras`, which outlive the result.
std::vector<tks_camera> toldCameras(const std::vector<Camera>& cameras, const GroundAxes& axes);

Result<std::vector<Camera>> chooseCameras(const CameraChoice& choice, const Bounds& bounds);

}  // namespace tetrakis::tools
