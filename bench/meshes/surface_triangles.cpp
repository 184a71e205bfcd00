// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/meshes/surface_objects.hpp"
#include "bench/meshes/surface_simplified.hpp"
#include "bench/meshes/surface_studies.hpp"
#include "codec/remesh/cleaned_mesh.hpp"

namespace tetrakis::bench {
namespace {

/// What no number of triangles may change.
struct Edges {
  int64_t euler = 0;     ///< points - edges + triangles
  uint32_t open = 0;     ///< that one triangle has
  uint32_t crowded = 0;  ///< that two pairs of triangles have: two patches with one diagonal
};

Edges edgesOf(const TriangleMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, std::pair<int, int>> sides;  // there, and back
  std::vector<bool> used(mesh.points.size());
  Edges edges;
  for (const Triangle& t : mesh.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      auto& [there, back] = sides[std::minmax(a, b)];
      ++(a < b ? there : back);
      edges.euler += used[a] ? 0 : 1;
      used[a] = true;
    }
  }
  edges.euler += static_cast<int64_t>(mesh.triangles.size());
  for (const auto& [ends, both] : sides) {
    const auto [there, back] = both;
    edges.euler -= std::max(there, back);
    edges.open += static_cast<uint32_t>(std::abs(there - back));
    edges.crowded += there > 1 || back > 1 ? 1 : 0;
  }
  return edges;
}

ErrorCurve simplifiedMeshes(const SurfaceModel& model, uint32_t sizes) {
  const FloatMesh mesh = floatMesh(model.mesh());
  ErrorCurve curve;
  for (const uint32_t budget : budgetsOf(mesh, 2 * sizes)) {
    const FloatMesh simple = simplified(mesh, budget);
    if (3 * model.mesh().triangles.size() == simple.corners.size()) continue;  // the model itself
    curve.push_back(
        {errorOf(model, triangleMesh(simple)), static_cast<double>(simple.corners.size() / 3)});
  }
  return curve;
}

/// The largest of some streams whose base has no more than half of the triangles that are wanted.
class Streams {
 public:
  explicit Streams(const SurfaceModel& model) : model_(model) {}

  /// Null where even the smallest one has more.
  const SurfaceObject* forTriangles(uint32_t triangles, uint32_t& kilobytes) {
    for (kilobytes = 64; kilobytes >= 2; kilobytes /= 2) {
      auto found = made_.find(kilobytes);
      if (found == made_.end()) {
        Result<SurfaceObject> object =
            surfaceObject(model_, {kilobytes << 10, TKS_OBJECT_RESAMPLED, false});
        if (!object.ok()) continue;
        found = made_.emplace(kilobytes, std::move(*object)).first;
      }
      if (4 * found->second.report.patches <= triangles) return &found->second;
    }
    return nullptr;
  }

 private:
  const SurfaceModel& model_;
  std::map<uint32_t, SurfaceObject> made_;
};

struct Lines {
  ColumnValues kilobytes, open, crowded, errors, ours, theirs;

  void addNothing() {
    for (ColumnValues* line : {&kilobytes, &open, &crowded, &errors, &ours, &theirs})
      line->push_back(std::nullopt);
  }
};

}  // namespace

Status studyTriangles(const SurfaceModel& model, const SurfaceStudyOptions& options,
                      SurfaceFigures& figures) {
  const int64_t euler = edgesOf(cleaned(model.mesh()).mesh).euler;
  const ErrorCurve peers = simplifiedMeshes(model, options.sizes);
  Streams streams(model);
  Lines lines;
  for (const double wanted : figures.columns()) {
    if (wanted >= static_cast<double>(model.mesh().triangles.size())) {
      lines.addNothing();
      continue;
    }
    uint32_t kilobytes = 0;
    const SurfaceObject* object = streams.forTriangles(static_cast<uint32_t>(wanted), kilobytes);
    if (object == nullptr) return {TKS_USAGE, "no stream has so few triangles"};
    const auto stream = object->stream.bytes();
    const Result<tools::PaintedMesh> mesh =
        decodedPrefix(stream, stream.size(), static_cast<uint32_t>(wanted));
    if (!mesh.ok()) return mesh.status();
    const Edges edges = edgesOf(mesh->mesh);
    if (edges.euler != euler)
      return {TKS_MISMATCH, "a mesh of " + model.name + " has another topology than the model"};
    lines.kilobytes.push_back(kilobytes);
    lines.open.push_back(edges.open);
    lines.crowded.push_back(edges.crowded);
    lines.errors.push_back(errorOf(model, mesh->mesh));
    lines.ours.push_back(static_cast<double>(mesh->mesh.triangles.size()));
    lines.theirs.push_back(costAt({peers}, *lines.errors.back()));
  }
  figures.printColumns("triangles, at most", 0);
  SurfaceFigures::print("kB of the stream", lines.kilobytes, 0);
  SurfaceFigures::print("open edges", lines.open, 0);
  SurfaceFigures::print("edges of four triangles", lines.crowded, 0);
  SurfaceFigures::print("error", lines.errors, 2);
  SurfaceFigures::print("tetrakis", lines.ours, 0);
  SurfaceFigures::print("meshoptimizer", lines.theirs, 0);
  figures.ratios(model.name, "triangles over meshoptimizer", lines.ours, lines.theirs);
  return {};
}

namespace {

/// wanted: of the stream. what: the triangles that are collapsed, in the names of rows.
Status studyCollapsed(const SurfaceModel& model, const SurfaceStudyOptions& options,
                      const ObjectOptions& stream_options, const std::string& what,
                      SurfaceFigures& figures) {
  const Result<SurfaceObject> object = surfaceObject(model, stream_options);
  if (!object.ok()) return object.status();
  const FloatMesh whole = floatMesh(model.mesh());
  const auto stream = object->stream.bytes();
  const int64_t euler = edgesOf(cleaned(model.mesh()).mesh).euler;
  const ErrorCurve peers = simplifiedMeshes(model, options.sizes);
  ColumnValues errors, theirs, ours, at_equal_error, open;
  for (const double wanted : figures.columns()) {
    const auto triangles = static_cast<uint32_t>(wanted);
    if (triangles >= model.mesh().triangles.size()) {
      for (ColumnValues* line : {&errors, &theirs, &ours, &at_equal_error, &open})
        line->push_back(std::nullopt);
      continue;
    }
    const Result<tools::PaintedMesh> mesh = decodedPrefix(stream, stream.size(), triangles);
    if (!mesh.ok()) return mesh.status();
    const Edges edges = edgesOf(mesh->mesh);
    if (edges.euler != euler) std::printf("  another topology at %u triangles\n", triangles);
    open.push_back(edges.open);
    errors.push_back(errorOf(model, mesh->mesh));
    theirs.push_back(errorOf(model, triangleMesh(simplified(whole, triangles))));
    ours.push_back(static_cast<double>(mesh->mesh.triangles.size()));
    at_equal_error.push_back(costAt({peers}, *errors.back()));
  }
  figures.printColumns((what + ", at most").c_str(), 0);
  SurfaceFigures::print("open edges", open, 0);
  SurfaceFigures::print("error", errors, 2);
  SurfaceFigures::print("meshoptimizer: error", theirs, 2);
  figures.ratios(model.name, "error of " + what + " over meshoptimizer", errors, theirs);
  figures.ratios(model.name, what + " over meshoptimizer", ours, at_equal_error);
  return {};
}

}  // namespace

Status studyKept(const SurfaceModel& model, const SurfaceStudyOptions& options,
                 SurfaceFigures& figures) {
  constexpr uint64_t kAll = 8 << 20;
  return studyCollapsed(model, options, {kAll, TKS_OBJECT_TRIANGLES, false}, "kept triangles",
                        figures);
}

Status studyFew(const SurfaceModel& model, const SurfaceStudyOptions& options,
                SurfaceFigures& figures) {
  constexpr uint64_t kFineBase = 64 << 10;
  return studyCollapsed(model, options, {kFineBase, TKS_OBJECT_RESAMPLED, false},
                        "triangles of patches", figures);
}

}  // namespace tetrakis::bench
