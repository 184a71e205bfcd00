// SPDX-License-Identifier: Apache-2.0
// Objects through the C interface: a mesh of any triangles becomes heights over a base mesh, or
// triangles on a grid, whichever comes nearer to it.
#include <algorithm>
#include <cstddef>

#include "api/encoded_stream.hpp"
#include "api/guarded.hpp"
#include "api/object_inputs.hpp"
#include "base/watch.hpp"
#include "codec/remesh/mesh_topology.hpp"

namespace tetrakis::inline api {
namespace {

/// Whether `a` is the better stream of the two for one target.
bool isBetter(const CodedObject& a, const CodedObject& b, const tks_encode_options& options) {
  if (options.bytes == 0) return a.stream.size() < b.stream.size();
  // Of two streams with a texture one may be nearer in shape, the other in colour: the product of
  // both errors counts a part of the one as much as the same part of the other. Colours that are
  // off by less than rounding are all alike.
  constexpr double kRounding = 0.29;
  const auto errorOf = [&](const CodedObject& coded) {
    return coded.distance.error * std::max(coded.texture_error, kRounding);
  };
  return errorOf(a) < errorOf(b);
}

Result<CodedObject> encodedAs(tks_object_kind kind, GivenObject& given) {
  if (kind == TKS_OBJECT_RESAMPLED) return encodeResampled(given);
  if (kind == TKS_OBJECT_TRIANGLES) return encodeTriangles(given);
  Result<CodedObject> resampled = encodeResampled(given);
  Result<CodedObject> triangles = encodeTriangles(given);
  if (!triangles.ok()) return resampled;
  if (!resampled.ok() || isBetter(*triangles, *resampled, given.options)) return triangles;
  return resampled;
}

tks_object_report reportOf(const ObjectSource& source, const CodedObject& coded) {
  tks_object_report report{};
  report.size = sizeof report;
  const CleanedMesh& cleaned = source.cleaned();
  const Topology topology = topologyOf(cleaned.mesh);
  report.triangles = static_cast<uint32_t>(cleaned.mesh.triangles.size());
  report.dropped_triangles = cleaned.report.degenerate + cleaned.report.doubled;
  report.cut_edges = cleaned.report.cut_edges;
  report.components = topology.components;
  report.borders = topology.boundary_loops;
  report.patches = coded.patches;
  report.depth = coded.depth;
  report.diagonal = source.diagonal();
  report.resampling_error = coded.resampling_error;
  report.error = coded.distance.error;
  report.largest = std::max(coded.distance.to_first.largest, coded.distance.to_second.largest);
  report.psnr = coded.distance.psnr;
  report.texture_depth = coded.texture_depth;
  report.kind = coded.kind;
  report.coded_triangles = coded.coded_triangles;
  return report;
}

Status encodeObject(const tks_triangle_mesh* mesh, const tks_image* image,
                    const tks_encode_options* options, tks_object_report* report, tks_buffer& out) {
  if (mesh == nullptr) return misusedObject("The mesh is missing.");
  if (options == nullptr) return misusedObject("The encoding options are missing.");
  tks_triangle_mesh given{};
  Status status = takeSized("the mesh", *mesh, offsetof(tks_triangle_mesh, unit), given);
  if (!status.ok()) return status;
  tks_encode_options known{};
  status =
      takeSized("the encoding options", *options, offsetof(tks_encode_options, threads), known);
  if (status.ok()) status = checkObjectOptions(known);
  if (!status.ok()) return status;
  tks_image texture{};
  if (image != nullptr)
    status = takeSized("the texture", *image, offsetof(tks_image, geotransform), texture);
  if (status.ok() && image != nullptr && known.bytes == 0)
    status = misusedObject("A mesh with an image takes a number of bytes as its target.");
  if (status.ok()) status = checkMeshImage(given, image != nullptr ? &texture : nullptr);
  if (status.ok() && (given.kind < TKS_OBJECT_AUTO || given.kind > TKS_OBJECT_TRIANGLES))
    status = misusedObject("Unknown kind of object.");
  if (!status.ok()) return status;
  constexpr size_t kLeastReport = offsetof(tks_object_report, kind);
  if (report != nullptr && (report->size < kLeastReport || report->size > kMostStructBytes))
    return misusedObject("The struct of the report has a wrong size.");
  const Result<TriangleMesh> triangles = meshOf(given);
  if (!triangles.ok()) return triangles.status();
  GivenObject object(given, *triangles, image != nullptr ? &texture : nullptr, known);
  if (object.source.cleaned().mesh.triangles.empty())
    return misusedObject("No triangle of the mesh is left: all have corners at equal places.");
  const Result<CodedObject> coded = encodedAs(given.kind, object);
  if (!coded.ok()) return coded.status();
  if (report != nullptr) giveSized(reportOf(object.source, *coded), *report);
  giveBytes(coded->stream, out);
  return {};
}

}  // namespace
}  // namespace tetrakis::inline api

tks_status tks_encode_object(const tks_triangle_mesh* mesh, const tks_image* image,
                             const tks_encode_options* options, tks_object_report* report,
                             tks_buffer* out, char* message, size_t message_size) {
  if (out != nullptr) *out = {nullptr, 0};
  return tetrakis::reporting(message, message_size, [&]() -> tetrakis::Status {
    if (out == nullptr) return tetrakis::outputMissing();
    try {
      return tetrakis::encodeObject(mesh, image, options, report, *out);
    } catch (const tetrakis::Stopped&) {
      return tetrakis::misusedObject("Encoding was stopped by the caller.");
    }
  });
}
