// SPDX-License-Identifier: Apache-2.0
// Processor time and memory of decimation; see decimation_speed.hpp.
#include "bench/meshes/decimation_speed.hpp"

#include <cstdio>
#include <ctime>
#include <functional>

#include "bench/harness/averages.hpp"
#include "bench/meshes/decimation_peers.hpp"
#include "bench/peers/child_memory.hpp"
#include "codec/mesh/fitted_heights.hpp"
#include "codec/mesh/gains/gains.hpp"
#include "codec/mesh/study/study.hpp"

namespace tetrakis::bench {
namespace {

constexpr uint32_t kSide = 1025;
constexpr uint32_t kPeerTriangles = 20000;

/// Heights of a square cut out of, or mirrored from, a raster.
struct Tile {
  Raster raster;
  std::vector<int32_t> heights;

  Tile(const Raster& source, uint32_t side)
      : raster(mirrorTo(source, side, side)),
        heights(raster.samples.begin(), raster.samples.end()) {}
  SurfaceView view() const { return {raster.width, raster.height, heights}; }
};

double processorSeconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

struct Task {
  const char* name;
  std::function<void()> work;
  std::vector<double> seconds = {};
};

void findHull(const SurfaceView& view) {
  const Lattice lattice = *Lattice::make(view.width, view.height);
  const std::vector<double> gains = vertexGains(lattice, view);
  const MeshHull hull(lattice, gains, closureSlopes(lattice, gains));
}

void besideMeshoptimizer(const Raster& source, int runs, std::vector<ResultRow>& rows) {
  const Tile tile(source, kSide);
  const Simplifier simplifier(tile.raster, 0.01);
  std::vector<Task> tasks = {{"meshoptimizer_20k", [&] { simplifier.run(kPeerTriangles); }},
                             {"order", [&] { static_cast<void>(decimate(tile.view()).ok()); }},
                             {"fitted_order",
                              [&] {
                                static_cast<void>(FittedSequence::make({tile.view(), {}}).ok());
                              }},
                             {"hull", [&] { findHull(tile.view()); }}};
  for (int i = 0; i < runs; ++i)
    for (Task& task : tasks) task.seconds.push_back(processorSeconds(task.work));
  const double peer = median(tasks[0].seconds);
  std::printf("\n%u x %u, seconds          of meshoptimizer's\n", kSide, kSide);
  for (const Task& task : tasks) {
    const double seconds = median(task.seconds);
    std::printf("%-20s %8.3f %8.3f\n", task.name, seconds, seconds / peer);
    rows.push_back({task.name, "tetrakis", "seconds_1025", seconds});
    rows.push_back({task.name, "tetrakis", "time_ratio", seconds / peer});
  }
  rows[0].codec = rows[1].codec = "meshoptimizer";
}

Status scaling(const Raster& source, int runs, std::vector<ResultRow>& rows) {
  std::printf("\n%8s %10s %14s %16s\n", "side", "seconds", "ns / vertex", "bytes / vertex");
  const Tile least(source, 9);
  for (uint32_t side = 129; side <= 4097; side = 2 * side - 1) {
    const Tile tile(source, side);
    const auto work = [&] { return decimate(tile.view()).status(); };
    std::vector<double> seconds;
    for (int i = 0; i < (side > kSide ? 1 : runs); ++i)
      seconds.push_back(processorSeconds([&] { static_cast<void>(work().ok()); }));
    const Result<uint64_t> peak = peakMemory(work, [&] { return decimate(least.view()).status(); });
    if (!peak.ok()) return peak.status();
    const double vertices = static_cast<double>(tile.heights.size());
    const double time = median(seconds), bytes = static_cast<double>(*peak) / vertices;
    std::printf("%8u %10.3f %14.0f %16.1f\n", side, time, time / vertices * 1e9, bytes);
    const std::string item = "side_" + std::to_string(side);
    rows.push_back({item, "tetrakis", "ns_per_vertex", time / vertices * 1e9});
    rows.push_back({item, "tetrakis", "peak_bytes_per_vertex", bytes});
  }
  return {};
}

}  // namespace

Result<std::vector<ResultRow>> timeDecimation(const Raster& raster, int runs) {
  std::vector<ResultRow> rows;
  besideMeshoptimizer(raster, runs, rows);
  const Status status = scaling(raster, runs, rows);
  if (!status.ok()) return status;
  return rows;
}

}  // namespace tetrakis::bench
