// SPDX-License-Identifier: Apache-2.0
// The functions here turn surfaces and 4-8 meshes into scenes: ground frames, and meshes placed in
// metres.
#pragma once

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/place/ground_axes.hpp"
#include "apps/tools/render/render.hpp"
#include "apps/tools/report/sample_surface.hpp"
#include "codec/ground/camera.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::tools {

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

/// Every sample a vertex, every cell two triangles with the diagonals of the tetrakis tiling, but
/// for triangles that touch a void (NaN).
MeshFile fullGrid(const Surface& heights, const PlacedFrame& frame);

/// A decoded mesh in space, texture coordinates (column / (width - 1), row / (height - 1)).
MeshFile placeMesh(const Mesh& mesh, const PlacedFrame& frame);

/// Bounds of the placed surface, voids left out.
Bounds boundsOf(const Surface& heights, const PlacedFrame& frame);

}  // namespace tetrakis::tools
