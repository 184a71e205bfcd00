// SPDX-License-Identifier: Apache-2.0
#include "bench/meshes/surface_objects.hpp"

#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {

Result<ErrorCurve> surfaceObjects(const TriangleMesh& mesh) {
  constexpr double kUnit = 1e4, kFewest = 400, kMost = 64 << 10, kRatio = 1.5;
  tks_triangle_mesh given = makeTriangleMesh();
  given.vertex_count = static_cast<uint32_t>(mesh.points.size());
  given.triangle_count = static_cast<uint32_t>(mesh.triangles.size());
  given.positions = mesh.points.front().data();
  given.triangles = mesh.triangles.front().data();
  ErrorCurve curve;
  Status last{TKS_USAGE, "No number of bytes is asked for."};
  for (double bytes = kFewest; bytes <= kMost; bytes *= kRatio) {
    tks_encode_options options = makeEncodeOptions();
    options.bytes = static_cast<uint64_t>(bytes);
    tks_object_report report{};
    const Result<Buffer> stream = encodeObject(given, nullptr, options, &report);
    if (!stream.ok()) {
      last = stream.status();
      continue;
    }
    curve.push_back(
        {kUnit * report.error / report.diagonal, static_cast<double>(stream->bytes().size())});
  }
  if (curve.empty()) return last;
  return curve;
}

}  // namespace tetrakis::bench
