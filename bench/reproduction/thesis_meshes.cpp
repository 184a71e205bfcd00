// SPDX-License-Identifier: Apache-2.0
// bench_thesis_meshes [FOLDER]: chapter 5 of the thesis on the central 257 x 257 samples of height
// fields: general against restricted decimation and refinement, global against local error
// (figs. 5.8, 5.10, 5.11, 5.13), falls of the slope and rises of the error (5.4.2), and the times
// of table 5.1.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "apps/tools/synth/synth.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/averages.hpp"
#include "bench/harness/height_files.hpp"
#include "bench/harness/results.hpp"
#include "bench/peers/raster.hpp"
#include "bench/reproduction/thesis_direct.hpp"
#include "codec/mesh/decimation/decimation.hpp"
#include "codec/mesh/gains/gains.hpp"
#include "codec/mesh/study/study.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;

constexpr uint32_t kSide = 257;             // samples a side of the thesis's terrains
constexpr double kWorst = 1e5;              // e_max of (5.28), so that no error is 50 dB
constexpr uint32_t kUnstable = 3000;        // triangles up to which fig. 5.8 is drawn step by step
constexpr uint32_t kDirectVertices = 5000;  // the direct algorithm is timed up to there
constexpr uint32_t kRepeatedSide = 2049;    // larger meshes are decimated once

struct Options {
  std::string folder;  // empty: the sample terrain
  std::string meshes;
  uint32_t most_files = 1000;
  uint32_t most_side = 1025;
  int runs = 3;
  std::string csv;
};

struct Terrain {
  std::string name;
  uint32_t side = 0;
  std::vector<int32_t> heights;

  SurfaceView view() const { return {side, side, heights}; }
};

struct Policy {
  const char* name;
  MeshPolicy policy;
};

constexpr Policy kPolicies[] = {{"general", MeshPolicy::kGeneralDecimation},
                                {"restricted", MeshPolicy::kRestrictedDecimation},
                                {"local_decimation", MeshPolicy::kLocalDecimation},
                                {"local_refinement", MeshPolicy::kLocalRefinement},
                                {"near_hull", MeshPolicy::kNearHull}};

constexpr uint32_t kPictured[] = {200, 400, 800, 1600, 3200, 6400};  // fig. 5.13

/// Fails if the raster is smaller, or has voids or a single height there.
Result<Terrain> centreOf(const Raster& raster, const std::string& name) {
  if (raster.width < kSide || raster.height < kSide)
    return Status(TKS_USAGE, name + " is smaller than 257 x 257 samples");
  const uint32_t left = (raster.width - kSide) / 2, top = (raster.height - kSide) / 2;
  Terrain terrain{name, kSide, {}};
  for (uint32_t y = top; y < top + kSide; ++y)
    for (uint32_t x = left; x < left + kSide; ++x) {
      const size_t i = size_t{y} * raster.width + x;
      if (!raster.real.empty() && raster.real[i] == 0)
        return Status(TKS_USAGE, name + " has voids in its central 257 x 257 samples");
      terrain.heights.push_back(raster.samples[i]);
    }
  const auto [low, high] = std::minmax_element(terrain.heights.begin(), terrain.heights.end());
  if (*low == *high) return Status(TKS_USAGE, name + " is flat in its central 257 x 257 samples");
  return terrain;
}

struct Ground {
  std::vector<Terrain> terrains;
  Raster first;  ///< whole; table 5.1 mirrors it to its sizes
};

Status addFile(const std::filesystem::path& path, Ground& ground) {
  const Result<tools::HeightFile> file = tools::readHeights(path.string());
  if (!file.ok()) return file.status();
  Result<Raster> raster = heightRaster(*file);
  if (!raster.ok()) return raster.status();
  const std::string folder = path.parent_path().filename().string();
  Result<Terrain> terrain =
      centreOf(*raster, path.stem() == "height" ? folder : path.stem().string());
  if (!terrain.ok()) return terrain.status();
  if (ground.terrains.empty()) ground.first = std::move(*raster);
  ground.terrains.push_back(std::move(*terrain));
  return {};
}

Result<Ground> readGround(const Options& options) {
  Ground ground;
  if (options.folder.empty()) {
    tools::SynthOptions synth;
    synth.size = std::max(kSide, std::min(options.most_side, 1025u));
    Result<Raster> raster = heightRaster(tools::synthesize(synth).heights);
    if (!raster.ok()) return raster.status();
    Result<Terrain> terrain = centreOf(*raster, "sample");
    if (!terrain.ok()) return terrain.status();
    ground.terrains.push_back(std::move(*terrain));
    ground.first = std::move(*raster);
    return ground;
  }
  for (const auto& path : heightFilesBelow(options.folder, {})) {
    if (ground.terrains.size() == options.most_files) break;
    const Status status = addFile(path, ground);
    if (!status.ok()) std::fprintf(stderr, "left out: %s\n", status.message().c_str());
  }
  if (ground.terrains.empty())
    return Status(TKS_USAGE, "The folder has no height field of 257 x 257 samples without voids.");
  return ground;
}

double decibels(double error, double worst) {
  return 10 * std::log10(kWorst / (error * kWorst / worst + 1));
}

/// The error of the largest mesh of at most so many triangles, monotone or not.
double errorAt(const MeshSequence& sequence, uint32_t triangles) {
  size_t low = 0, high = sequence.order().size();
  while (low < high) {
    const size_t middle = (low + high + 1) / 2;
    if (sequence.triangleCount(middle) <= triangles)
      low = middle;
    else
      high = middle - 1;
  }
  return sequence.squaredError(low);
}

/// Budgets a twelfth of a power of two apart, with those of fig. 5.13.
std::vector<uint32_t> budgets() {
  std::vector<uint32_t> all(std::begin(kPictured), std::end(kPictured));
  for (const uint32_t round : {2u, 10u, 25u, 50u, 100u, 12800u, 25600u, 51200u, 102400u})
    all.push_back(round);
  for (double b = 4; b < 2.0 * (kSide - 1) * (kSide - 1); b *= std::exp2(0.25))
    all.push_back(static_cast<uint32_t>(b));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// What one policy does, means over terrains.
struct Course {
  std::vector<double> decibels;  ///< by budget
  double steps = 0, rises = 0, falls = 0;
};

/// Steps of decimation: how often the error falls though triangles go (which, read as refinement,
/// is a rise), and how often the slope falls.
void countSteps(const Lattice& lattice, const std::vector<double>& gains,
                const std::vector<VertexId>& order, const std::vector<uint32_t>& steps,
                Course& course) {
  size_t end = order.size();
  double before = -std::numeric_limits<double>::infinity();
  for (const uint32_t removed : steps) {
    double distortion = 0;
    uint32_t cost = 0;
    for (size_t i = end - removed; i < end; ++i) {
      distortion += gains[order[i]];
      cost += lattice.triangleCost(lattice.site(order[i]));
    }
    end -= removed;
    const double slope = slopeOf(distortion, cost);
    course.rises += distortion < 0 ? 1 : 0;
    course.falls += slope < before ? 1 : 0;
    before = slope;
    ++course.steps;
  }
}

/// Fig. 5.8: one terrain, the mesh after every step at low rates.
void traceSteps(const MeshSequence& sequence, const std::vector<uint32_t>& steps,
                const char* policy, std::vector<ResultRow>& rows) {
  const double worst = sequence.squaredError(0);
  size_t left = sequence.order().size();
  for (const uint32_t removed : steps) {
    left -= removed;
    const uint32_t triangles = sequence.triangleCount(left);
    if (triangles <= kUnstable)
      rows.push_back({"trace_" + std::to_string(triangles), policy, "db",
                      decibels(sequence.squaredError(left), worst)});
  }
}

/// Corners of the triangles, one triangle a line, in samples and height steps.
Status writeMesh(const Terrain& terrain, const LatticeMesh& mesh, const std::string& path) {
  std::ofstream file(path);
  file << "x0,y0,z0,x1,y1,z1,x2,y2,z2\n";
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const uint32_t sample = mesh.vertices[mesh.triangles[i]];
    file << sample % terrain.side << ',' << sample / terrain.side << ',' << terrain.heights[sample]
         << (i % 3 == 2 ? '\n' : ',');
  }
  file.close();
  return file ? Status() : Status(TKS_IO, "Cannot write " + path + ".");
}

/// The meshes of fig. 5.13, and their quality on every terrain.
Status pictureMeshes(const Terrain& terrain, const MeshSequence& sequence,
                     const std::string& folder) {
  for (const uint32_t triangles : kPictured) {
    const std::string path = folder + "/mesh_" + std::to_string(triangles) + ".csv";
    const LatticeMesh mesh = sequence.mesh(sequence.bestPrefix(triangles));
    if (Status status = writeMesh(terrain, mesh, path); !status.ok()) return status;
  }
  return {};
}

/// Orders one terrain by one policy. steps: vertices that each step removes, first step first.
Result<MeshSequence> order(const Terrain& terrain, const Policy& policy, Course& course,
                           std::vector<uint32_t>& steps) {
  Result<MeshSequence> sequence = decimate(terrain.view(), {policy.policy, {}});
  if (!sequence.ok()) return sequence;
  const Lattice& lattice = sequence->lattice();
  const std::vector<double> gains = vertexGains(lattice, terrain.view());
  steps.assign(sequence->order().size(), 1);
  if (policy.policy == MeshPolicy::kGeneralDecimation) {
    steps.clear();
    generalDecimation(gains, VertexCosts(lattice), MergingDomains::kPromptLevels, &steps);
  }
  countSteps(lattice, gains, sequence->order(), steps, course);
  return sequence;
}

/// What is told of one terrain alone: its quality at the sizes of fig. 5.13, and, of the first, its
/// meshes and steps.
Status reportTerrain(const Terrain& terrain, bool first, const MeshSequence& sequence,
                     const std::string& meshes, std::vector<ResultRow>& rows) {
  const double worst = sequence.squaredError(0);
  for (const uint32_t triangles : kPictured)
    rows.push_back({terrain.name, "general", "db_at_" + std::to_string(triangles),
                    decibels(errorAt(sequence, triangles), worst)});
  return first && !meshes.empty() ? pictureMeshes(terrain, sequence, meshes) : Status();
}

void reportCourse(const Policy& policy, const Course& mean, const std::vector<uint32_t>& all,
                  std::vector<ResultRow>& rows) {
  std::printf("%-18s %9.0f %8.1f %8.1f", policy.name, mean.steps, mean.rises, mean.falls);
  rows.push_back({"mean", policy.name, "steps", mean.steps});
  rows.push_back({"mean", policy.name, "rises", mean.rises});
  rows.push_back({"mean", policy.name, "falls", mean.falls});
  for (size_t i = 0; i < all.size(); ++i) {
    rows.push_back({"mean", policy.name, "db_at_" + std::to_string(all[i]), mean.decibels[i]});
    if (std::find(std::begin(kPictured), std::end(kPictured), all[i]) != std::end(kPictured))
      std::printf(" %7.2f", mean.decibels[i]);
  }
  std::printf("\n");
}

Status measurePolicies(const Ground& ground, const Options& options, std::vector<ResultRow>& rows) {
  const std::vector<uint32_t> all = budgets();
  const auto terrains = static_cast<double>(ground.terrains.size());
  rows.push_back({"all", "terrains", "count", terrains});
  std::printf("%-18s %9s %8s %8s", "mean", "steps", "rises", "falls");
  for (const uint32_t triangles : kPictured) std::printf(" %7u", triangles);
  std::printf("\n");
  for (const Policy& policy : kPolicies) {
    Course course{std::vector<double>(all.size()), 0, 0, 0};
    std::vector<uint32_t> steps;
    for (const Terrain& terrain : ground.terrains) {
      const Result<MeshSequence> sequence = order(terrain, policy, course, steps);
      if (!sequence.ok()) return sequence.status();
      const double worst = sequence->squaredError(0);
      if (worst == 0) return {TKS_USAGE, terrain.name + " is a plane: leave it out."};
      for (size_t i = 0; i < all.size(); ++i)
        course.decibels[i] += decibels(errorAt(*sequence, all[i]), worst) / terrains;
      const bool first = &terrain == ground.terrains.data();
      if (first) traceSteps(*sequence, steps, policy.name, rows);
      if (policy.policy != MeshPolicy::kGeneralDecimation) continue;
      if (Status status = reportTerrain(terrain, first, *sequence, options.meshes, rows);
          !status.ok())
        return status;
    }
    course.steps /= terrains;
    course.rises /= terrains;
    course.falls /= terrains;
    reportCourse(policy, course, all, rows);
  }
  return {};
}

/// Sorts the vertices of each step by id: which of them comes first is a matter of taste. steps:
/// from the last vertex of the order to the first.
void sortSteps(std::vector<VertexId>& order, const std::vector<uint32_t>& steps) {
  auto end = order.end();
  for (const uint32_t removed : steps) {
    std::sort(end - removed, end);
    end -= removed;
  }
}

double processorSeconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

struct Times {
  double initial = 0, decimation = 0;
  std::vector<double> gains;
  std::vector<VertexId> order;  ///< each step sorted
};

/// The initialisation is the gains of all vertices and the sums over complete domains; the
/// decimation is the rest, its queue included.
Times timesOf(const Lattice& lattice, const Terrain& terrain, int runs) {
  const VertexCosts costs(lattice);
  Times times;
  std::vector<double> initial, decimation;
  std::vector<uint32_t> steps;
  for (int run = 0; run < runs; ++run) {
    const double sums =
        processorSeconds([&] { times.gains = vertexGains(lattice, terrain.view()); });
    const double domains = processorSeconds([&] { const MergingDomains all(times.gains, costs); });
    steps.clear();
    const double both = processorSeconds([&] {
      times.order = generalDecimation(times.gains, costs, MergingDomains::kPromptLevels, &steps);
    });
    initial.push_back(sums + domains);
    decimation.push_back(std::max(both - domains, 0.0));
  }
  times.initial = median(initial);
  times.decimation = median(decimation);
  sortSteps(times.order, steps);
  return times;
}

/// Table 5.1, decimation by local error (proposition 3.3), and the direct algorithm, which must
/// give the same steps.
Status measureTimes(const Ground& ground, const Options& options, std::vector<ResultRow>& rows) {
  std::printf("\n%9s %12s %12s %12s %12s  seconds of processor time\n", "triangles", "initial",
              "decimation", "local error", "direct");
  for (uint32_t side = 33; side <= options.most_side; side = 2 * side - 1) {
    const Raster square = mirrorTo(ground.first, side, side);
    const Terrain terrain{"", side,
                          std::vector<int32_t>(square.samples.begin(), square.samples.end())};
    const Lattice lattice = *Lattice::make(side, side);
    const Times times = timesOf(lattice, terrain, side > kRepeatedSide ? 1 : options.runs);
    const std::string triangles = std::to_string(uint64_t{2} * (side - 1) * (side - 1));
    std::printf("%9s %12.5f %12.5f", triangles.c_str(), times.initial, times.decimation);
    rows.push_back({"n_" + triangles, "general", "initial_s", times.initial});
    rows.push_back({"n_" + triangles, "general", "decimation_s", times.decimation});
    if (side <= kRepeatedSide) {
      const double seconds = processorSeconds([&] {
        (void)decimate(terrain.view(), {MeshPolicy::kLocalDecimation, {}});
      });
      std::printf(" %12.5f", seconds);
      rows.push_back({"n_" + triangles, "local_decimation", "all_s", seconds});
    }
    if (lattice.vertexCount() <= kDirectVertices) {
      std::vector<VertexId> direct;
      const double seconds =
          processorSeconds([&] { direct = directDecimation(times.gains, VertexCosts(lattice)); });
      if (direct != times.order)
        return {TKS_MISMATCH, "The direct algorithm removes other vertices."};
      std::printf(" %12.5f", seconds);
      rows.push_back({"n_" + triangles, "direct", "decimation_s", seconds});
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  return {};
}

Status run(const Options& options) {
  const Result<Ground> ground = readGround(options);
  if (!ground.ok()) return ground.status();
  std::vector<ResultRow> rows;
  if (Status status = measurePolicies(*ground, options, rows); !status.ok()) return status;
  if (Status status = measureTimes(*ground, options, rows); !status.ok()) return status;
  return updateResults(options.csv, "thesis_meshes", rows);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Arguments arguments("Chapter 5 of the thesis: decimation of meshes, its errors and its times");
  arguments.text({"FOLDER", "Height files below it; without it the sample terrain"},
                 options.folder);
  arguments.text({"--meshes", "Folder for the meshes of fig. 5.13"}, options.meshes);
  arguments.within({"--files", "Height files at most"}, options.most_files, 1, 1000000);
  arguments.within({"--most", "Most samples a side in table 5.1"}, options.most_side, 33, 8193);
  arguments.runs(options.runs);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return exitCode(run(options));
}
