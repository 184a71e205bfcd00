// SPDX-License-Identifier: Apache-2.0
// runTriangles() codes a mesh of triangles: how sides are glued, where vertices lie, which sides
// are seams of the texture, and where wedges lie on it. Each knows all that came before.
#pragma once

#include <utility>

#include "bitstream/stream/glue_pass.hpp"
#include "codec/trianglemesh/corner_fans.hpp"
#include "codec/trianglemesh/place_pass.hpp"
#include "codec/trianglemesh/seam_pass.hpp"
#include "codec/trianglemesh/texcoord_pass.hpp"

namespace tetrakis::inline trianglemesh {

/// Io: as of coder/value_table_pass.hpp. mesh: of the decoder empty; becomes what all decoders
/// have. Whether the codeword is that of a mesh, and did not end early.
template <class Io>
bool runTriangles(Io& io, const TriangleMeshHeader& header, CodedTriangles& mesh) {
  mesh.sides.resize(3 * header.triangles, kBorder);
  if (!GluePass(io, static_cast<uint32_t>(header.triangles), 3).run(mesh.sides)) return false;
  CornerFans vertices = cornerFans(mesh.sides);
  mesh.places.resize(vertices.first.size());
  PlacePass(io, mesh.sides, vertices, header.place_bits).run(mesh.places);
  if (header.texcoord_bits > 0) {
    if (mesh.cut.empty()) mesh.cut = mesh.sides;
    SeamPass(io, mesh.sides, vertices).run(mesh.cut);
  }
  mesh.vertices = std::move(vertices.of_corner);
  if (header.texcoord_bits > 0) {
    CornerFans wedges = cornerFans(mesh.cut);
    mesh.texcoords.resize(wedges.first.size());
    TexcoordPass(io, mesh, wedges, header.texcoord_bits).run(mesh.texcoords);
    mesh.wedges = std::move(wedges.of_corner);
  }
  return !io.stopped();
}

}  // namespace tetrakis::inline trianglemesh
