// SPDX-License-Identifier: Apache-2.0
// bench_decimation DIR...: meshes of height fields, beside Martini, Delatin, meshoptimizer and
// Draco.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>

#include "apps/tools/files/files.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/averages.hpp"
#include "bench/harness/height_files.hpp"
#include "bench/harness/results.hpp"
#include "bench/meshes/decimation_quality.hpp"
#include "bench/meshes/decimation_speed.hpp"
#include "bench/meshes/first_mesh.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;
namespace fs = std::filesystem;

const std::vector<uint32_t> kBudgets = {200, 400, 800, 1600, 3200, 6400, 12800, 25600};

struct Options {
  std::vector<std::string> folders, filters;
  std::string node = "build/decimation-node", csv;
  int runs = 3;
  bool bytes = true;
};

struct Terrain {
  std::string item;
  Raster tile;
  double exaggeration = 1;  ///< columns a sample step
};

/// Geometric means over the terrains.
class Means {
 public:
  void add(const std::string& codec, const std::string& quantity, double value) {
    values_[{codec, quantity}].push_back(value);
  }
  std::vector<ResultRow> rows() const {
    std::vector<ResultRow> rows;
    for (const auto& [key, values] : values_)
      rows.push_back({"mean", key.first, key.second, geometricMean(values)});
    return rows;
  }

 private:
  std::map<std::pair<std::string, std::string>, std::vector<double>> values_;
};

bool holdsHeights(const fs::path& path) {
  const std::string extension = path.extension().string();
  return path.stem() != "texture" &&
         (extension == ".tif" || extension == ".hgt" || extension == ".exr");
}

Result<Terrain> load(const fs::path& path) {
  const Result<tools::HeightFile> file = tools::readHeights(path.string());
  if (!file.ok()) return file.status();
  const Result<Raster> raster = heightRaster(*file);
  if (!raster.ok()) return raster.status();
  Terrain terrain{path.parent_path().filename().string() + "/" + path.stem().string(),
                  centralTile(*raster), 1};
  const auto& samples = terrain.tile.samples;
  const auto [low, high] = std::minmax_element(samples.begin(), samples.end());
  const double spacing = 0.5 * (file->spacing_x + file->spacing_y);
  terrain.exaggeration = spacing > 0 ? terrain.tile.unit / spacing
                                     : terrain.tile.width / std::max(1.0, 1.0 * *high - *low);
  return terrain;
}

Result<std::vector<PeerMesh>> peerMeshes(const Terrain& terrain, const Options& options) {
  std::vector<uint32_t> budgets;
  for (const uint32_t budget : kBudgets)
    if (2 * budget < terrain.tile.pixels() * 2) budgets.push_back(budget);
  auto peers = nodeMeshes(terrain.tile, options.node, budgets);
  if (!peers.ok()) return peers;
  const Simplifier simplifier(terrain.tile, terrain.exaggeration);
  for (const uint32_t budget : budgets)
    peers->push_back({"meshoptimizer", budget, simplifier.run(budget)});
  return peers;
}

Status compareWithHull(const Terrain& terrain, std::vector<ResultRow>& rows) {
  const auto gaps = gapsToHull(terrain.tile);
  if (!gaps.ok()) return gaps.status();
  double at_corner = 0, to_chord = 0, optimal = 0;
  std::printf("  dB above the hull at the triangles of its corners:");
  for (const GapPoint& point : *gaps) {
    std::printf(" %u: %.4f", point.corner, point.at_corner);
    at_corner = std::max(at_corner, point.at_corner);
  }
  std::printf("\n  dB above its chords at rates (optimal order):");
  for (const GapPoint& point : *gaps) {
    std::printf(" %u: %.4f (%.4f)", point.triangles, point.to_chord, point.optimal_to_chord);
    to_chord = std::max(to_chord, point.to_chord);
    optimal = std::max(optimal, point.optimal_to_chord);
  }
  std::printf("\n");
  rows.push_back({terrain.item, "tetrakis", "worst_gap_db", at_corner});
  rows.push_back({terrain.item, "tetrakis", "worst_chord_gap_db", to_chord});
  rows.push_back({terrain.item, "tetrakis_optimal", "worst_chord_gap_db", optimal});
  return {};
}

Status compareFirstMesh(const Terrain& terrain, int runs, std::vector<ResultRow>& rows) {
  const auto times = timeFirstMesh(terrain.tile, runs);
  if (!times.ok()) return times.status();
  std::printf(
      "  first %zu bytes to %u triangles: %.1f ms, %zu bytes %.1f ms; OpenJPEG at 1 bit: %.1f ms\n",
      kFirstBytes, kFirstTriangles, times->first_ms, kMoreBytes, times->more_ms,
      times->openjpeg_ms);
  rows.push_back({terrain.item, "tetrakis", "first_2k_to_3000_triangles_ms", times->first_ms});
  rows.push_back({terrain.item, "tetrakis", "64k_to_3000_triangles_ms", times->more_ms});
  rows.push_back({terrain.item, "openjpeg97", "decode_1bpp_ms", times->openjpeg_ms});
  return {};
}

Status compareErrors(const Terrain& terrain, const std::vector<PeerMesh>& peers,
                     std::vector<ResultRow>& rows, Means& means) {
  const auto points = comparedMeshes(terrain.tile, peers);
  if (!points.ok()) return points.status();
  for (const MeshPoint& point : *points) {
    // A peer that stops far from the budget (meshoptimizer on few triangles) is no comparison.
    if (point.triangles > 1.1 * point.budget) continue;
    const std::string at = std::to_string(point.budget);
    std::printf("  %-14s %6u triangles: rmse %9.4g, tetrakis %9.4g, ratio %.3f\n",
                point.peer.c_str(), point.triangles, point.peer_rmse, point.rmse,
                point.rmse / point.peer_rmse);
    rows.push_back({terrain.item, point.peer, "rmse_at_" + at, point.peer_rmse});
    rows.push_back({terrain.item, "tetrakis", "rmse_to_" + point.peer + "_at_" + at,
                    point.rmse / point.peer_rmse});
    means.add("tetrakis", "rmse_to_" + point.peer + "_at_" + at, point.rmse / point.peer_rmse);
  }
  return {};
}

Status compareBytes(const Terrain& terrain, const std::vector<PeerMesh>& peers,
                    std::vector<ResultRow>& rows, Means& means) {
  const auto points = comparedBytes(terrain.tile, peers);
  if (!points.ok()) return points.status();
  for (const BytePoint& point : *points) {
    const double ratio = static_cast<double>(point.bytes) / static_cast<double>(point.peer_bytes);
    std::printf(
        "  rmse %9.4g (%.4g): Draco %7llu bytes, %6u triangles; tetrakis %7llu, %7u; "
        "ratio %.3f\n",
        point.goal, point.rmse, static_cast<unsigned long long>(point.peer_bytes),
        point.peer_triangles, static_cast<unsigned long long>(point.bytes), point.triangles, ratio);
    const std::string name = "bytes_to_draco_at_" + std::to_string(point.budget);
    rows.push_back({terrain.item, "tetrakis", name, ratio});
    means.add("tetrakis", name, ratio);
    means.add("tetrakis", "bytes_to_draco", ratio);
  }
  return {};
}

Status compare(const Terrain& terrain, const Options& options, std::vector<ResultRow>& rows,
               Means& means) {
  std::printf("\n%s, %u x %u\n", terrain.item.c_str(), terrain.tile.width, terrain.tile.height);
  Status status = compareWithHull(terrain, rows);
  if (status.ok()) status = compareFirstMesh(terrain, options.runs, rows);
  if (!status.ok()) return status;
  const auto peers = peerMeshes(terrain, options);
  if (!peers.ok()) return peers.status();
  status = compareErrors(terrain, *peers, rows, means);
  if (status.ok() && options.bytes) status = compareBytes(terrain, *peers, rows, means);
  std::fflush(stdout);
  return status;
}

Status run(const Options& options) {
  const std::vector<fs::path> files = filesBelow(options.folders, options.filters, holdsHeights);
  if (files.empty()) return {TKS_IO, "No height field found to make meshes of."};
  std::vector<ResultRow> rows;
  Means means;
  Raster largest;
  for (const fs::path& file : files) {
    Result<Terrain> terrain = load(file);
    if (!terrain.ok()) return terrain.status();
    const Status status = compare(*terrain, options, rows, means);
    if (!status.ok()) return status;
    if (terrain->tile.pixels() > largest.pixels()) largest = std::move(terrain->tile);
  }
  std::printf("\ngeometric means\n");
  for (const ResultRow& row : means.rows()) {
    std::printf("  %-34s %.3f\n", row.quantity.c_str(), row.value);
    rows.push_back(row);
  }
  const auto times = timeDecimation(largest, options.runs);
  if (!times.ok()) return times.status();
  rows.insert(rows.end(), times->begin(), times->end());
  return updateResults(options.csv, "decimation", rows);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Arguments arguments("Meshes of height fields, beside Martini, Delatin, meshoptimizer and Draco");
  arguments.folders(options.folders, options.filters);
  arguments.text({"--node", "Folder with the npm packages of Martini and Delatin"}, options.node);
  arguments.unset({"--no-bytes", "Leaves out streams and Draco: faster"}, options.bytes);
  arguments.runs(options.runs);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return exitCode(run(options));
}
