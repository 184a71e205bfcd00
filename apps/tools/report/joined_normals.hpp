// SPDX-License-Identifier: Apache-2.0
// joinedNormals() makes normals of a mesh that is cut open where textures have seams.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tetrakis::tools {

/// Three numbers a vertex, of length 1: the sum over the triangles at its place, each weighing its
/// area. Vertices with equal positions (three numbers each) have the same normal, so that no light
/// falls otherwise on either side of a seam. (0, 1, 0) where no triangle has an area.
std::vector<float> joinedNormals(std::span<const double> positions,
                                 std::span<const uint32_t> triangles);

}  // namespace tetrakis::tools
