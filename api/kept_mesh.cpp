// SPDX-License-Identifier: Apache-2.0
// Meshes kept for many views, through the C interface.
#include <algorithm>
#include <array>
#include <cmath>

#include "api/guarded.hpp"
#include "api/surface_mesh.hpp"
#include "codec/mesh/quadtree/mesh_tree.hpp"
#include "codec/mesh/void_mesh.hpp"

struct tks_mesh_tree {
  tetrakis::MeshTree tree;
  tetrakis::MapBox box;
};

namespace tetrakis::inline api {
namespace {

Status decodeTree(tks_decoder& decoder, tks_mesh_kind kind, uint32_t max_triangles,
                  tks_mesh_tree*& out) {
  const Result<SurfaceMesh> surface = surfaceMesh(decoder, kind, max_triangles);
  if (!surface.ok()) return surface.status();
  out = new tks_mesh_tree{
      MeshTree(surface->lattice, surface->inserted, surface->heights),
      MapBox::around(surface->lattice.width(), surface->lattice.height(), surface->heights)};
  return {};
}

Status viewMesh(const tks_mesh_tree& tree, const double* clip, tks_mesh& out) {
  std::array<double, 16> matrix;
  std::copy_n(clip, matrix.size(), matrix.begin());
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(matrix.begin(), matrix.end(), finite))
    return {TKS_USAGE, "The matrix of a view must be finite."};
  ViewMesh view = tree.tree.view(viewFootprint(matrix, tree.box));
  leaveOutVoids(view.mesh, view.heights);
  copyMesh(view.mesh, view.heights, out);
  return {};
}

}  // namespace
}  // namespace tetrakis::inline api

tks_status tks_decode_mesh_tree(tks_decoder* decoder, tks_mesh_kind kind, uint32_t max_triangles,
                                tks_mesh_tree** out) {
  if (out == nullptr) return tetrakis::keeping(decoder, tetrakis::outputMissing);
  if (decoder == nullptr) return TKS_USAGE;
  *out = nullptr;
  return tetrakis::keeping(
      decoder, [&] { return tetrakis::decodeTree(*decoder, kind, max_triangles, *out); });
}

tks_status tks_view_mesh(const tks_mesh_tree* tree, const double clip[16], tks_mesh* out) {
  if (tree == nullptr || clip == nullptr || out == nullptr) return TKS_USAGE;
  *out = {};
  const tks_status status =
      tetrakis::answering([&] { return tetrakis::viewMesh(*tree, clip, *out); });
  if (status != TKS_OK) tks_free_mesh(out);
  return status;
}

void tks_free_mesh_tree(tks_mesh_tree* tree) {
  delete tree;
}
