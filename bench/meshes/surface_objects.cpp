// SPDX-License-Identifier: Apache-2.0
#include "bench/meshes/surface_objects.hpp"

#include <algorithm>
#include <utility>

namespace tetrakis::bench {

Result<SurfaceObject> surfaceObject(const SurfaceModel& model, const ObjectOptions& options) {
  const TriangleMesh& mesh = model.mesh();
  tks_triangle_mesh given = makeTriangleMesh();
  given.vertex_count = static_cast<uint32_t>(mesh.points.size());
  given.triangle_count = static_cast<uint32_t>(mesh.triangles.size());
  given.positions = mesh.points.front().data();
  given.triangles = mesh.triangles.front().data();
  given.kind = options.kind;
  given.sketch_bytes = options.sketched ? 0 : TKS_NO_SKETCH;
  tks_image image{};
  if (options.textured) {
    given.texcoords = model.painted.texcoords.front().data();
    image = tools::asImage(*model.painted.image);
  }
  tks_encode_options encoding = makeEncodeOptions();
  encoding.bytes = options.bytes;
  tks_object_report report{};
  Result<Buffer> stream =
      encodeObject(given, options.textured ? &image : nullptr, encoding, &report);
  if (!stream.ok()) return stream.status();
  return SurfaceObject{std::move(*stream), report};
}

Result<ErrorCurve> surfaceObjects(const SurfaceModel& model) {
  constexpr double kFewest = 400, kMost = 64 << 10, kRatio = 1.5;
  ErrorCurve curve;
  Status last{TKS_USAGE, "No number of bytes is asked for."};
  for (double bytes = kFewest; bytes <= kMost; bytes *= kRatio) {
    const Result<SurfaceObject> object =
        surfaceObject(model, {static_cast<uint64_t>(bytes), TKS_OBJECT_AUTO, false});
    if (!object.ok()) {
      last = object.status();
      continue;
    }
    curve.push_back(
        {inUnits(model, object->report.error), static_cast<double>(object->stream.bytes().size())});
  }
  if (curve.empty()) return last;
  return curve;
}

Result<tools::PaintedMesh> decodedPrefix(std::span<const uint8_t> stream, size_t bytes,
                                         uint32_t max_triangles) {
  Result<Decoder> decoder = Decoder::open(stream.first(std::min(bytes, stream.size())));
  if (!decoder.ok()) return decoder.status();
  return tools::decodedMesh(*decoder, max_triangles);
}

}  // namespace tetrakis::bench
