// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "bench/meshes/surface_objects.hpp"
#include "bench/meshes/surface_peers.hpp"
#include "bench/meshes/surface_studies.hpp"

namespace tetrakis::bench {
namespace {

void printPoints(const std::vector<PeerCoding>& codings) {
  for (const PeerCoding& coding : codings)
    std::printf("  %7u triangles, %2u bits: error %7.3f, %8.0f bytes\n", coding.triangles,
                coding.bits, coding.point.error, coding.point.cost);
}

/// The least of some curves.
ColumnValues bytesOf(const std::vector<ErrorCurve>& curves, const std::vector<double>& errors) {
  ColumnValues bytes;
  for (const double error : errors) bytes.push_back(costAt(curves, error));
  return bytes;
}

}  // namespace

Status studyBytes(const SurfaceModel& model, const SurfaceStudyOptions& options,
                  SurfaceFigures& figures) {
  const Result<std::vector<PeerCoding>> codings =
      surfacePeers(model, floatMesh(model.mesh()), options.sizes);
  if (!codings.ok()) return codings.status();
  const Result<ErrorCurve> objects = surfaceObjects(model);
  if (!objects.ok()) return objects.status();
  if (options.points) {
    printPoints(*codings);
    for (const ErrorPoint& point : *objects)
      std::printf("  an object: error %7.3f, %8.0f bytes\n", point.error, point.cost);
  }
  figures.printColumns("bytes at an error of", 2);
  const ColumnValues ours = bytesOf({*objects}, figures.columns());
  const ColumnValues theirs = bytesOf(curvesOf(*codings), figures.columns());
  SurfaceFigures::print("meshoptimizer + Draco", theirs, 0);
  SurfaceFigures::print("tetrakis", ours, 0);
  figures.ratios(model.name, "bytes over best other", ours, theirs);
  return {};
}

}  // namespace tetrakis::bench
