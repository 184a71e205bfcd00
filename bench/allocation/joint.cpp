// SPDX-License-Identifier: Apache-2.0
// bench_joint DIR...: bytes shared between heights and texture (thesis, chapter 6), for every
// terrain with a texture: how far the encoder's order is from the best one, what other codecs make
// of the same bytes, and the figures of the chapter.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "bench/allocation/joint_studies.hpp"
#include "bench/harness/arguments.hpp"

namespace tetrakis::bench {
namespace {

struct Options {
  std::vector<std::string> folders, filters, studies;
  SplitOptions splits;
  uint32_t speed = 6;
  double spacing = 0;
  std::string figures, csv;

  bool wants(const char* study) const {
    return std::find(studies.begin(), studies.end(), study) != studies.end();
  }
};

Status studyTerrain(const Terrain& terrain, const Options& options, std::vector<ResultRow>& rows) {
  std::printf("%s\n", terrain.name.c_str());
  Status status;
  if (options.wants("splits")) status = studySplits(terrain, options.splits, rows);
  if (status.ok() && options.wants("peers")) status = studyPeers(terrain, options.speed, rows);
  if (status.ok() && options.wants("triangles"))
    status = studyTriangles(terrain, options.speed, rows);
  if (status.ok() && options.wants("prefixes")) status = studyPrefixes(terrain, rows);
  if (status.ok() && !options.figures.empty())
    status = drawFigures(terrain, options.splits.grid,
                         (std::filesystem::path(options.figures) / terrain.name).string(), rows);
  return status;
}

Status run(const Options& options) {
  std::vector<ResultRow> rows;
  for (const auto& folder : terrainsBelow(options.folders, options.filters)) {
    const Result<Terrain> terrain = readTerrain(folder, options.spacing);
    if (!terrain.ok()) return terrain.status();
    if (Status status = studyTerrain(*terrain, options, rows); !status.ok()) return status;
  }
  return updateResults(options.csv, "joint", rows);
}

}  // namespace
}  // namespace tetrakis::bench

int main(int argc, char** argv) {
  using namespace tetrakis::bench;
  Options options;
  Arguments arguments("Bytes shared between heights and texture, judged on the screen");
  arguments.folders(options.folders, options.filters);
  arguments.choices({"--study", "What is measured (default: splits, unless there are --figures)"},
                    options.studies, {"splits", "peers", "triangles", "prefixes"});
  arguments.text({"--figures", "Folder for figures 6.4 to 6.10 of each terrain"}, options.figures);
  arguments.within({"--grid",
                    "Splits rendered for each number of bytes, beside nine tenths; rates "
                    "of heights and of textures in figures"},
                   options.splits.grid, 2, 200);
  arguments.positive({"--spacing", "Metres per sample, instead of what the files say"},
                     options.spacing);
  arguments.text({"--view", "Preset cameras that are told and judge: all, low, oblique, top"},
                 options.splits.view);
  arguments.flag({"--rendered", "Also the order of `encode --engine rendered`"},
                 options.splits.rendered);
  arguments.within({"--speed", "Of avifenc; 0 is the slowest and best"}, options.speed, 0, 10);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  if (options.studies.empty() && options.figures.empty()) options.studies = {"splits"};
  return exitCode(run(options));
}
