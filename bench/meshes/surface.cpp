// SPDX-License-Identifier: Apache-2.0
// bench_surface FILE...: bytes of the geometry of triangle meshes at equal error, which is the
// larger of the two RMS distances between a mesh and what is decoded, in 1e-4 of the diagonal of
// its bounding box.
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/tools/files/meshes/surface_file.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/averages.hpp"
#include "bench/harness/height_files.hpp"
#include "bench/meshes/surface_objects.hpp"
#include "bench/meshes/surface_peers.hpp"

namespace tetrakis::bench {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> files;
  std::vector<double> errors = {3.5, 2.5, 1.75, 1.2};
  uint32_t sizes = 10;
  bool points = false;
};

/// Files, and those of folders and the folders below, by name.
std::vector<std::string> meshFiles(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    for (const fs::path& file : filesBelow(
             {path}, {}, [](const fs::path& found) { return tools::isMeshFile(found.string()); }))
      files.push_back(file.string());
  }
  return files;
}

/// Points of files are distinct already; triangles of fewer than three points say nothing.
TriangleMesh weldedMesh(tools::SurfaceFile file) {
  TriangleMesh mesh{std::move(file.points), std::move(file.triangles)};
  std::erase_if(mesh.triangles,
                [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return mesh;
}

using BytesAtErrors = std::vector<std::optional<double>>;

/// The least of some curves.
BytesAtErrors bytesOf(const std::vector<ErrorCurve>& curves, const std::vector<double>& errors) {
  BytesAtErrors bytes;
  for (const double error : errors) bytes.push_back(bytesAt(curves, error));
  return bytes;
}

/// Numbers below the errors; "-" where there is none.
void print(const char* name, const BytesAtErrors& values, int digits) {
  std::printf("  %-22s", name);
  for (const std::optional<double>& value : values) {
    if (value)
      std::printf(" %9.*f", digits, *value);
    else
      std::printf(" %9s", "-");
  }
  std::printf("\n");
}

/// Of the bytes of objects to those of peers, all files so far, for each error.
class Ratios {
 public:
  explicit Ratios(size_t errors) : ratios_(errors) {}

  /// Those of one file, which it keeps.
  BytesAtErrors add(const BytesAtErrors& objects, const BytesAtErrors& peers) {
    BytesAtErrors ratios(objects.size());
    for (size_t i = 0; i < ratios.size(); ++i) {
      if (!objects[i] || !peers[i]) continue;
      ratios[i] = *objects[i] / *peers[i];
      ratios_[i].push_back(*ratios[i]);
    }
    return ratios;
  }

  /// Geometric means over the files.
  BytesAtErrors means() const {
    BytesAtErrors means;
    for (const std::vector<double>& all : ratios_)
      means.push_back(all.empty() ? std::nullopt : std::optional(geometricMean(all)));
    return means;
  }

 private:
  std::vector<std::vector<double>> ratios_;
};

void printPoints(const std::vector<PeerCoding>& codings) {
  for (const PeerCoding& coding : codings)
    std::printf("  %7u triangles, %2u bits: error %7.3f, %8.0f bytes\n", coding.triangles,
                coding.bits, coding.point.error, coding.point.bytes);
}

/// One for each precision: the sizes of a curve have others between them, its precision has not.
Result<std::vector<ErrorCurve>> peerCurves(const TriangleMesh& mesh, const Options& options) {
  const Result<std::vector<PeerCoding>> codings = surfacePeers(mesh, options.sizes);
  if (!codings.ok()) return codings.status();
  if (options.points) printPoints(*codings);
  std::map<uint32_t, ErrorCurve> by_bits;
  for (const PeerCoding& coding : *codings) by_bits[coding.bits].push_back(coding.point);
  std::vector<ErrorCurve> curves;
  for (auto& [bits, curve] : by_bits) curves.push_back(std::move(curve));
  return curves;
}

Status measure(const Options& options, const std::string& path, Ratios& ratios) {
  Result<tools::SurfaceFile> file = tools::readSurface(path);
  if (!file.ok()) return file.status();
  const TriangleMesh mesh = weldedMesh(std::move(*file));
  if (!(diagonal(mesh) > 0) || mesh.triangles.empty())
    return {TKS_USAGE, path + " has no triangle of three points"};
  std::printf("%s: %zu triangles, %zu points\n", path.c_str(), mesh.triangles.size(),
              mesh.points.size());
  const Result<std::vector<ErrorCurve>> peers = peerCurves(mesh, options);
  if (!peers.ok()) return peers.status();
  const Result<ErrorCurve> objects = surfaceObjects(mesh);
  if (!objects.ok()) return objects.status();
  if (options.points) {
    for (const ErrorPoint& point : *objects)
      std::printf("  an object: error %7.3f, %8.0f bytes\n", point.error, point.bytes);
  }
  print("bytes at an error of", {options.errors.begin(), options.errors.end()}, 2);
  const BytesAtErrors ours = bytesOf({*objects}, options.errors);
  const BytesAtErrors theirs = bytesOf(*peers, options.errors);
  print("meshoptimizer + Draco", theirs, 0);
  print("tetrakis", ours, 0);
  print("tetrakis / best other", ratios.add(ours, theirs), 3);
  std::fflush(stdout);
  return {};
}

}  // namespace
}  // namespace tetrakis::bench

int main(int argc, char** argv) {
  using namespace tetrakis::bench;
  Options options;
  Arguments arguments("Bytes of triangle meshes at equal error.");
  arguments.required({"FILE", "meshes, and folders of meshes"}, options.files);
  arguments.numbers({"--errors", "in 1e-4 of the diagonal"}, options.errors);
  arguments.within({"--sizes", "that meshoptimizer simplifies to"}, options.sizes, 1, 100);
  arguments.flag({"--points", "also each coding that was tried"}, options.points);
  if (const auto code = arguments.parse(argc, argv)) return *code;
  int failed = 0;
  Ratios ratios(options.errors.size());
  for (const std::string& file : meshFiles(options.files)) {
    const tetrakis::Status status = measure(options, file, ratios);
    if (!status.ok()) failed = exitCode(status);
  }
  std::printf("geometric means\n");
  print("tetrakis / best other", ratios.means(), 3);
  return failed;
}
