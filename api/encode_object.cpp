// SPDX-License-Identifier: Apache-2.0
// Objects through the C interface: a mesh of any triangles becomes heights over a base mesh, or
// triangles on a grid, whichever comes nearer to it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "api/encoded_stream.hpp"
#include "api/guarded.hpp"
#include "api/object_inputs.hpp"
#include "api/object_maps.hpp"
#include "api/object_pictures.hpp"
#include "base/portable_math.hpp"
#include "base/watch.hpp"
#include "codec/remesh/mesh_topology.hpp"

namespace tetrakis::inline api {
namespace {

/// Whether `a` is the better stream of the two for one target.
bool isBetter(const CodedObject& a, const CodedObject& b, const tks_encode_options& options) {
  if (options.bytes == 0) return a.stream.size() < b.stream.size();
  // Pictures tell whether it is the shape that is off, or the colours. Pictures that are off by
  // less than rounding are all alike.
  constexpr double kRounding = 1.0 / 12;
  if (std::max(a.picture_error, b.picture_error) > kRounding)
    return a.picture_error < b.picture_error;
  return a.distance.error < b.distance.error;
}

/// The streams of both kinds, as far as they were asked for and meet the target.
struct BothKinds {
  std::optional<CodedObject> resampled, triangles;
  bool takes_triangles = false;  ///< else the resampled object is the better one

  CodedObject taken() const { return takes_triangles ? *triangles : *resampled; }
};

/// At least one kind meets the target.
Result<BothKinds> encodedAs(tks_object_kind kind, GivenObject& given) {
  BothKinds both;
  Status status;
  if (kind != TKS_OBJECT_RESAMPLED) {
    Result<CodedObject> triangles = encodeTriangles(given);
    if (triangles.ok())
      both.triangles = *std::move(triangles);
    else
      status = triangles.status();
  }
  if (kind != TKS_OBJECT_TRIANGLES) {
    Result<CodedObject> resampled = encodeResampled(given);
    if (resampled.ok())
      both.resampled = *std::move(resampled);
    else
      status = resampled.status();
  }
  if (!both.resampled && !both.triangles) return status;
  both.takes_triangles =
      both.triangles &&
      (!both.resampled || isBetter(*both.triangles, *both.resampled, given.options));
  return both;
}

tks_object_trial trialOf(const std::optional<CodedObject>& coded) {
  if (!coded) return {};
  constexpr double kWhite = 255;
  const double picture = coded->picture_error;
  if (picture < 0) return {coded->stream.size(), coded->distance.psnr, 0};
  return {coded->stream.size(), coded->distance.psnr,
          picture > 0 ? 10 * portable::log10(kWhite * kWhite / picture) : HUGE_VAL};
}

tks_object_report reportOf(const ObjectSource& source, const BothKinds& both,
                           const CodedObject& coded) {
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
  report.sketch_bytes = coded.sketch_bytes;
  report.as_resampled = trialOf(both.resampled);
  report.as_triangles = trialOf(both.triangles);
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
  Result<std::vector<GivenMap>> maps = takenMaps(given, image != nullptr);
  if (!maps.ok()) return maps.status();
  object.maps = *std::move(maps);
  std::optional<ObjectPictures> pictures;
  if (known.camera_count > 0 && image == nullptr)
    return misusedObject("Cameras weigh an image against the mesh, and there is none.");
  if (image != nullptr) {
    Result<ObjectPictures> drawn = ObjectPictures::of(object);
    if (!drawn.ok()) return drawn.status();
    object.pictures = &pictures.emplace(*std::move(drawn));
  }
  const Result<BothKinds> both = encodedAs(given.kind, object);
  if (!both.ok()) return both.status();
  Result<CodedObject> coded = withSketch(object, both->taken());
  if (coded.ok()) coded = withMaps(object, *std::move(coded));
  if (!coded.ok()) return coded.status();
  if (report != nullptr) giveSized(reportOf(object.source, *both, *coded), *report);
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
