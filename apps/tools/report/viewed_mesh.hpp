// SPDX-License-Identifier: Apache-2.0
// viewedMesh() makes the part of a mesh that a camera sees, and meshForCameras() makes a mesh for
// cameras.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/tools/report/camera_choice.hpp"
#include "apps/tools/report/scene.hpp"

namespace tetrakis::tools {

/// Clip coordinates of (column, row, height, 1) for tks_view_mesh: row by row, the third row zero.
std::array<double, 16> clipOf(const Camera& camera, const PlacedFrame& frame);

/// The chosen cameras, over the decoded surface.
Result<std::vector<Camera>> camerasOver(Decoder& decoder, const CameraChoice& choice);

/// The mesh of a decoded surface, coded or of every sample, as far as the one chosen camera sees
/// it. TKS_USAGE for several cameras, or if no ground is in view.
Result<Mesh> viewedMesh(Decoder& decoder, bool coded, const CameraChoice& choice);

/// The camera for tks_decode_screen_mesh and tks_reorder, over the heights of this frame.
tks_screen_camera meshCamera(const Camera& camera, const PlacedFrame& frame);

/// Those of the chosen cameras that have a weight. TKS_USAGE with the name of a camera that has no
/// ground in view, or if none has a weight.
Result<std::vector<tks_screen_camera>> meshCameras(Decoder& decoder, const CameraChoice& choice);

/// The same of cameras of a file that look at a globe, which outlives them. Their places are those
/// of globeMesh(): metres from the centre, with the north pole at y. TKS_USAGE also: presets, or
/// heights that go round no globe.
Result<std::vector<tks_screen_camera>> globeCameras(Decoder& decoder, const CameraChoice& choice,
                                                    const tks_globe& globe);

/// The mesh of at most `triangles` > 0 triangles that is best for the chosen cameras; nothing
/// chosen: for a map. texture: what covers the ground, or null. TKS_USAGE with the name of a camera
/// that has no ground in view.
Result<Mesh> meshForCameras(Decoder& decoder, uint32_t triangles, const CameraChoice& choice,
                            const ImageFile* texture);

}  // namespace tetrakis::tools
