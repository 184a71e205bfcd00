// SPDX-License-Identifier: Apache-2.0
// collapsedObject() leaves few triangles of a resampled object, fewer than its patches have:
// vertices collapse into neighbours as those of kept triangles do
// (codec/trianglemesh/fewer_triangles.hpp), across the sides of patches.
//
// A triangle that is left shows what it showed of the texture, so that it stays within one patch,
// however far its corners go. Corners in several patches would show all that lies between these.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "codec/mesh/forest/glued_triangles.hpp"

namespace tetrakis::inline api {

/// A mesh of less than this part of the base's triangles collapses from the base. A finer mesh
/// comes nearer to the surface if it collapses from twice its triangles, which take longer to
/// choose.
inline constexpr uint32_t kMostFromBase = 8;

/// Vertices by the samples of a raster that they are.
struct ObjectVertices {
  std::vector<uint32_t> places;     ///< where each lies
  std::vector<uint32_t> texels;     ///< what each shows of a texture
  std::vector<uint32_t> triangles;  ///< three vertices each
};

/// places: of all samples of the raster; those that are one have one place. most: 1 or more.
/// textured: vertices come once for each texel that they show. No edge opens but as
/// fewerTriangles() says. The same on every machine.
ObjectVertices collapsedObject(const GluedTriangles& mesh,
                               const std::vector<std::array<double, 3>>& places, uint32_t most,
                               bool textured);

}  // namespace tetrakis::inline api
