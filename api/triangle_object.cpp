// SPDX-License-Identifier: Apache-2.0
#include "api/triangle_object.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "api/memory.hpp"
#include "api/written.hpp"
#include "codec/trianglemesh/coded_triangles.hpp"
#include "codec/trianglemesh/fewer_triangles.hpp"

namespace tetrakis::inline api {
namespace {

Result<CodedTriangles> decodedTriangles(const tks_decoder& decoder) {
  const TriangleMeshHeader& header = decoder.parsed.header.triangle_mesh;
  constexpr uint64_t kTriangleBytes = 300;
  const std::string work = "A mesh of " + std::to_string(header.triangles) + " triangles";
  const Status status = checkWork(decoder, work, kTriangleBytes * header.triangles);
  if (!status.ok()) return status;
  return decodeTriangles(header);
}

/// One corner of each vertex that receivers draw: vertices with other texcoords are others.
std::vector<uint32_t> cornersOfVertices(const std::vector<uint32_t>& vertices) {
  std::vector<uint32_t> corners;
  for (uint32_t corner = 0; corner < vertices.size(); ++corner)
    if (vertices[corner] == corners.size()) corners.push_back(corner);
  return corners;
}

void copyTriangles(const TriangleMeshHeader& header, const CodedTriangles& mesh,
                   tks_object_mesh& out) {
  const bool textured = !mesh.wedges.empty();
  const std::vector<uint32_t>& vertices = textured ? mesh.wedges : mesh.vertices;
  const std::vector<uint32_t> corners = cornersOfVertices(vertices);
  out.vertex_count = static_cast<uint32_t>(corners.size());
  out.triangle_count = static_cast<uint32_t>(vertices.size() / 3);
  out.position = allocate<double>(3 * corners.size());
  out.triangles = allocate<uint32_t>(vertices.size());
  std::copy(vertices.begin(), vertices.end(), out.triangles);
  for (size_t v = 0; v < corners.size(); ++v) {
    const Place& place = mesh.places[mesh.vertices[corners[v]]];
    for (size_t axis = 0; axis < 3; ++axis)
      out.position[3 * v + axis] =
          header.cell * static_cast<double>(header.origin[axis] + place[axis]);
  }
  if (!textured) return;
  out.texcoord = allocate<double>(2 * corners.size());
  for (size_t v = 0; v < corners.size(); ++v)
    for (size_t axis = 0; axis < 2; ++axis)
      out.texcoord[2 * v + axis] =
          std::ldexp(static_cast<double>(header.texcoord_origin[axis] + mesh.texcoords[v][axis]),
                     -header.texcoord_fraction);
}

}  // namespace

Status decodeTriangleObject(const tks_decoder& decoder, tks_mesh_kind kind, uint32_t max_triangles,
                            tks_object_mesh& out) {
  if (kind != TKS_MESH_BUDGET && kind != TKS_MESH_CODED)
    return {TKS_USAGE, "Unknown kind of mesh."};
  Result<CodedTriangles> mesh = decodedTriangles(decoder);
  if (!mesh.ok()) return mesh.status();
  const bool all = kind == TKS_MESH_CODED || max_triangles == 0;
  copyTriangles(decoder.parsed.header.triangle_mesh,
                all ? *std::move(mesh) : fewerTriangles(*std::move(mesh), max_triangles), out);
  return {};
}

Status checkTriangles(const tks_decoder& decoder) {
  return decodedTriangles(decoder).status();
}

}  // namespace tetrakis::inline api
