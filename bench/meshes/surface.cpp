// SPDX-License-Identifier: Apache-2.0
// bench_surface FILE...: triangle meshes of any shape as objects, beside meshoptimizer, Draco and
// AVIF. An error is the larger of the two RMS distances between a mesh and what is decoded, in 1e-4
// of the diagonal of its bounding box.
#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "bench/harness/arguments.hpp"
#include "bench/harness/results.hpp"
#include "bench/meshes/surface_studies.hpp"

namespace tetrakis::bench {
namespace {

struct Options {
  std::vector<std::string> files, studies;
  std::vector<double> errors = {3.5, 2.5, 1.75, 1.2};
  SurfaceStudyOptions study;
  std::string csv;
};

/// Rows of results.csv are those of one study each, so that one can be measured without the others.
struct Study {
  std::string name;
  SurfaceFigures figures;
};

Status measure(const SurfaceModel& model, const Options& options, Study& study) {
  if (study.name == "bytes") return studyBytes(model, options.study, study.figures);
  if (study.name == "triangles") return studyTriangles(model, options.study, study.figures);
  if (study.name == "kept") return studyKept(model, options.study, study.figures);
  if (study.name == "few") return studyFew(model, options.study, study.figures);
  if (study.name == "prefixes") return studyPrefixes(model, study.figures);
  return studyTexture(model, options.study, study.figures);
}

std::vector<Study> wantedStudies(const Options& options) {
  std::vector<Study> all = {{"bytes", {"at_error", options.errors}},
                            {"prefixes", {"at_kB", {2, 4, 8, 16, 32}}},
                            {"kept", {"at_triangles", {500, 1000, 2000, 4000, 8000, 16000}}},
                            {"few", {"at_triangles", {125, 250, 500, 1000, 2000, 4000}}},
                            {"texture", {"at_kB", {4, 8, 16, 32}}},
                            {"triangles", {"at_triangles", {2000, 4000, 8000, 16000, 32000}}}};
  std::erase_if(all, [&](const Study& study) {
    return !options.studies.empty() && std::find(options.studies.begin(), options.studies.end(),
                                                 study.name) == options.studies.end();
  });
  return all;
}

int run(const Options& options) {
  std::vector<Study> studies = wantedStudies(options);
  int failed = 0;
  for (const std::string& file : surfaceFiles(options.files)) {
    const auto model = readSurfaceModel(file);
    if (!model.ok()) {
      failed = exitCode(model.status());
      continue;
    }
    std::printf("%s: %zu triangles, %zu points\n", file.c_str(), (*model)->mesh().triangles.size(),
                (*model)->mesh().points.size());
    for (Study& study : studies)
      if (const Status status = measure(**model, options, study); !status.ok())
        failed = exitCode(status);
  }
  for (Study& study : studies) study.figures.printMeans();
  for (const Study& study : studies) {
    if (failed != 0) break;
    const Status status = updateResults(options.csv, "surface_" + study.name, study.figures.rows());
    if (!status.ok()) failed = exitCode(status);
  }
  return failed;
}

}  // namespace
}  // namespace tetrakis::bench

int main(int argc, char** argv) {
  using namespace tetrakis::bench;
  Options options;
  Arguments arguments("Triangle meshes of any shape as objects, beside other codecs.");
  arguments.required({"FILE", "meshes, and folders of meshes"}, options.files);
  arguments.choices({"--study", "What is measured (default: all)"}, options.studies,
                    {"bytes", "triangles", "kept", "few", "prefixes", "texture"});
  arguments.numbers({"--errors", "of bytes, in 1e-4 of the diagonal"}, options.errors);
  arguments.within({"--sizes", "that meshoptimizer simplifies to"}, options.study.sizes, 1, 100);
  arguments.flag({"--points", "also each coding of bytes that was tried"}, options.study.points);
  arguments.csv(options.csv);
  if (const auto code = arguments.parse(argc, argv)) return *code;
  return run(options);
}
