// SPDX-License-Identifier: Apache-2.0
// bench_quadtree [HEIGHT]: memory and time of storing an adaptive mesh in the semi-linear quadtree,
// beside other stores: table 4.1 of the thesis, measured. One thread, one process, alternating
// runs, medians of processor time; all stores must read the same heights.
#include <malloc.h>

#include <cstdio>
#include <ctime>
#include <functional>
#include <map>
#include <numeric>
#include <random>

#include "apps/tools/files/files.hpp"
#include "apps/tools/synth/synth.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/averages.hpp"
#include "bench/harness/results.hpp"
#include "bench/meshes/quadtree_classics.hpp"
#include "bench/peers/raster.hpp"
#include "codec/mesh/decimation/decimation.hpp"
#include "codec/mesh/quadtree/mesh_tree.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;

struct Options {
  std::string heights;  // empty: the sample terrain
  uint32_t side = 1025;
  int runs = 9;
  bool orders = false;  // more lengths of walks, and windows of more sizes
  std::string csv;
};

/// A mesh: its vertices in the lattice, and the nodes that hold them.
struct Mesh {
  std::string name;
  Lattice lattice;
  std::vector<VertexId> vertices;
  std::vector<float> heights;  ///< of meshOf()
  QuadtreeNodes stored;
};

/// The same reading for all stores: walks of `steps` nodes from nodes drawn at random.
struct Walks {
  std::string name;
  uint32_t steps = 1;
  std::vector<uint32_t> starts;
  std::vector<Direction> directions;
};

Result<std::vector<int32_t>> loadHeights(const Options& options) {
  tools::HeightFile file;
  if (options.heights.empty()) {
    tools::SynthOptions synth;
    synth.size = options.side;
    file = tools::synthesize(synth).heights;
  } else {
    auto read = tools::readHeights(options.heights);
    if (!read.ok()) return read.status();
    file = std::move(*read);
  }
  const Result<Raster> raster = heightRaster(file);
  if (!raster.ok()) return raster.status();
  const Raster square = mirrorTo(*raster, options.side, options.side);
  return std::vector<int32_t>(square.samples.begin(), square.samples.end());
}

QuadtreeNodes nodesOf(const MeshTree& tree) {
  const SemilinearQuadtree& quadtree = tree.quadtree();
  QuadtreeNodes stored;
  stored.shape = quadtree.shape();
  uint32_t number = quadtree.rootCount();
  quadtree.forEachVertex([&](const QuadtreePlace& place) {
    const float value = quadtree.values()[number++];
    stored.entries.push_back({place, value});
    if (place.tree != QuadtreePlace::kNodes) return;
    const Square square = stored.shape.squareOf(place.level, place.node);
    if (stored.nodes.empty() || stored.nodes.back().square != square)
      stored.nodes.push_back({square, {}, 0});
    QuadtreeNode& node = stored.nodes.back();
    node.values[place.vertex] = value;
    node.present |= static_cast<uint8_t>(1u << place.vertex);
  });
  return stored;
}

/// The complete mesh, and the best ones of a quarter and of a fiftieth of its triangles.
Result<std::vector<Mesh>> makeMeshes(const Options& options) {
  const Result<std::vector<int32_t>> heights = loadHeights(options);
  if (!heights.ok()) return heights.status();
  const auto sequence = decimate({options.side, options.side, *heights});
  if (!sequence.ok()) return sequence.status();
  std::vector<Mesh> meshes;
  const size_t all = sequence->order().size();
  for (const auto& [name, divisor] :
       {std::pair("complete", 1u), {"quarter", 4u}, {"fiftieth", 50u}}) {
    Mesh mesh{name, sequence->lattice(), sequence->order(), {}, {}};
    mesh.vertices.resize(
        divisor == 1 ? all : sequence->bestPrefix(sequence->triangleCount(all) / divisor));
    for (const uint32_t sample : meshOf(mesh.lattice, mesh.vertices).vertices)
      mesh.heights.push_back(static_cast<float>((*heights)[sample]));
    mesh.stored = nodesOf(MeshTree(mesh.lattice, mesh.vertices, mesh.heights));
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

std::vector<Walks> makeWalks(const QuadtreeNodes& stored, bool orders) {
  const uint32_t nodes_read = orders ? 1 << 18 : 1 << 20;
  std::vector<std::pair<std::string, uint32_t>> lengths = {
      {"neighbour", 1}, {"path_16", 16}, {"path_512", 512}};
  if (orders)
    for (const uint32_t steps : {2, 4, 8, 32, 64, 128, 256})
      lengths.emplace_back("path_" + std::to_string(steps), steps);
  std::vector<Walks> all;
  std::mt19937 random(1);
  for (const auto& [name, steps] : lengths) {
    Walks walks{name, steps, {}, {}};
    for (uint32_t i = 0; i < nodes_read / steps; ++i) {
      walks.starts.push_back(static_cast<uint32_t>(random() % stored.nodes.size()));
      walks.directions.push_back(static_cast<Direction>(random() % 4));
    }
    all.push_back(std::move(walks));
  }
  return all;
}

double processorSeconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Bytes that the program holds of the heap, the allocator's own included.
size_t heapBytes() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// One store, ready to be measured.
struct Contender {
  std::string name;
  size_t bytes = 0;
  std::function<double()> build;       ///< seconds, without what it takes to tear down
  std::function<double(size_t)> walk;  ///< sum of the heights read by walks i
};

template <class Store>
Contender contend(const Mesh& mesh, const std::vector<Walks>& walks) {
  using Handle = typename Store::Handle;
  const size_t before = heapBytes();
  const auto store = std::make_shared<const Store>(mesh.stored);
  Contender contender{Store::kName, heapBytes() - before, {}, {}};
  const auto handles = std::make_shared<std::vector<std::vector<Handle>>>();
  for (const Walks& w : walks) {
    std::vector<Handle>& starts = handles->emplace_back();
    for (const uint32_t start : w.starts) starts.push_back(store->handleOf(start));
  }
  contender.build = [&mesh] {
    std::optional<Store> built;
    return processorSeconds([&] { built.emplace(mesh.stored); });
  };
  contender.walk = [store, handles, &walks](size_t i) {
    double sum = 0;
    const Walks& w = walks[i];
    for (size_t k = 0; k < w.starts.size(); ++k)
      sum += store->walk((*handles)[i][k], w.directions[k], w.steps);
    return sum;
  };
  return contender;
}

/// Prints and records one figure of every store, and how many times ours the others are.
void report(const Mesh& mesh, const std::string& quantity, const std::vector<Contender>& contenders,
            const std::vector<double>& values, std::vector<ResultRow>& rows) {
  std::printf("%-9s %-22s", mesh.name.c_str(), quantity.c_str());
  for (size_t i = 0; i < contenders.size(); ++i) {
    const double ratio = values[i] / values[0];
    std::printf("  %10.2f (%5.2f)", values[i], ratio);
    rows.push_back({mesh.name, contenders[i].name, quantity, values[i]});
    if (i > 0) rows.push_back({mesh.name, contenders[i].name, quantity + "_ratio", ratio});
  }
  std::printf("\n");
  std::fflush(stdout);
}

Status measureStores(const Mesh& mesh, const Options& options, std::vector<ResultRow>& rows) {
  const std::vector<Walks> walks = makeWalks(mesh.stored, options.orders);
  const std::vector<Contender> contenders{
      contend<SemilinearStore>(mesh, walks), contend<PointerStore>(mesh, walks),
      contend<LinearStore>(mesh, walks),     contend<HashStore>(mesh, walks),
      contend<GridStore>(mesh, walks),       contend<SametStore>(mesh, walks),
      contend<GargantiniStore>(mesh, walks), contend<SchrackStore>(mesh, walks)};
  const auto vertices = static_cast<double>(mesh.stored.entries.size());
  std::vector<double> bytes;
  for (const Contender& c : contenders) bytes.push_back(static_cast<double>(c.bytes) / vertices);
  report(mesh, "bytes_per_vertex", contenders, bytes, rows);

  const auto alternating = [&](const std::function<double(const Contender&)>& seconds,
                               double elements) {
    std::vector<std::vector<double>> times(contenders.size());
    for (int run = 0; run < options.runs; ++run)
      for (size_t i = 0; i < contenders.size(); ++i) times[i].push_back(seconds(contenders[i]));
    std::vector<double> nanoseconds;
    for (const std::vector<double>& t : times) nanoseconds.push_back(1e9 * median(t) / elements);
    return nanoseconds;
  };
  report(mesh, "build_ns_per_vertex", contenders,
         alternating([](const Contender& c) { return c.build(); }, vertices), rows);
  for (size_t i = 0; i < walks.size(); ++i) {
    const double expected = contenders[0].walk(i);
    for (const Contender& c : contenders)
      if (c.walk(i) != expected)
        return {TKS_MISMATCH,
                "The stores 'semilinear' and '" + c.name + "' hold different heights."};
    const double nodes = static_cast<double>(walks[i].starts.size()) * walks[i].steps;
    const auto seconds = [&](const Contender& c) { return processorSeconds([&] { c.walk(i); }); };
    report(mesh, walks[i].name + "_ns_per_node", contenders, alternating(seconds, nodes), rows);
  }
  return {};
}

/// A square in the middle of the map, `share` of its width and of its height.
std::vector<MapPoint> windowOf(const Mesh& mesh, double share) {
  const double side = mesh.lattice.width() - 1;
  const double low = side * (1 - share) / 2, high = side * (1 + share) / 2;
  return {{low, low}, {low, high}, {high, high}, {high, low}};
}

/// Windows of growing size: time over what is seen (thesis 4.7).
void measureWindows(const Mesh& mesh, int runs, std::vector<ResultRow>& rows) {
  const MeshTree tree(mesh.lattice, mesh.vertices, mesh.heights);
  for (const uint32_t percent : {1, 2, 4, 8, 16, 32, 64, 100}) {
    const std::vector<MapPoint> window = windowOf(mesh, percent / 100.0);
    size_t triangles = 0;
    std::vector<double> times;
    for (int run = 0; run < runs; ++run)
      times.push_back(
          processorSeconds([&] { triangles = tree.view(window).mesh.triangleCount(); }));
    const std::string name = "view_" + std::to_string(percent);
    rows.push_back({mesh.name, name, "triangles", static_cast<double>(triangles)});
    rows.push_back({mesh.name, name, "ms", 1e3 * median(times)});
  }
}

/// Triangles of windows of the map out of the tree, and of the whole mesh with and without it.
void measureViews(const Mesh& mesh, int runs, std::vector<ResultRow>& rows) {
  const MeshTree tree(mesh.lattice, mesh.vertices, mesh.heights);
  const std::vector<MapPoint> tenth_window = windowOf(mesh, 0.1);
  std::vector<double> whole, without, tenth;
  size_t triangles = 0, tenth_triangles = 0;
  for (int run = 0; run < runs; ++run) {
    whole.push_back(processorSeconds([&] { triangles = tree.whole().mesh.triangleCount(); }));
    without.push_back(processorSeconds([&] { meshOf(mesh.lattice, mesh.vertices); }));
    tenth.push_back(
        processorSeconds([&] { tenth_triangles = tree.view(tenth_window).mesh.triangleCount(); }));
  }
  const auto perTriangle = [](const std::vector<double>& seconds, size_t count) {
    return 1e9 * median(seconds) / static_cast<double>(count);
  };
  const double ours = perTriangle(whole, triangles), grid = perTriangle(without, triangles);
  const double milliseconds = 1e3 * median(tenth);
  std::printf(
      "%-9s view: whole mesh %.1f ns a triangle, without the tree %.1f (%.2f); a window of "
      "1 %% (%zu of %zu triangles) %.3f ms, %.0f times faster than the whole without\n",
      mesh.name.c_str(), ours, grid, grid / ours, tenth_triangles, triangles, milliseconds,
      median(without) / median(tenth));
  rows.push_back({mesh.name, "semilinear", "whole_ns_per_triangle", ours});
  rows.push_back({mesh.name, "grid", "whole_ns_per_triangle", grid});
  rows.push_back({mesh.name, "grid", "whole_ns_per_triangle_ratio", grid / ours});
  rows.push_back({mesh.name, "semilinear", "window_ms", milliseconds});
}

Status run(const Options& options) {
  const auto meshes = makeMeshes(options);
  if (!meshes.ok()) return meshes.status();
  std::vector<ResultRow> rows;
  std::printf("%-9s %-22s", "mesh", "(times semilinear)");
  for (const char* name :
       {SemilinearStore::kName, PointerStore::kName, LinearStore::kName, HashStore::kName,
        GridStore::kName, SametStore::kName, GargantiniStore::kName, SchrackStore::kName})
    std::printf("  %18s", name);
  std::printf("\n");
  for (const Mesh& mesh : *meshes) {
    if (Status status = measureStores(mesh, options, rows); !status.ok()) return status;
    measureViews(mesh, options.runs, rows);
    if (options.orders) measureWindows(mesh, options.runs, rows);
  }
  return updateResults(options.csv, "quadtree", rows);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Arguments arguments("Stores of an adaptive mesh: the semi-linear quadtree and others");
  arguments.text({"HEIGHT", "Height file; without it the sample terrain"}, options.heights);
  arguments.within({"--side", "Samples a side"}, options.side, 65, 4097);
  arguments.flag({"--orders", "More lengths of walks and sizes of windows: for their orders"},
                 options.orders);
  arguments.runs(options.runs);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return exitCode(run(options));
}
