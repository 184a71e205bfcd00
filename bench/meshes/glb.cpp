// SPDX-License-Identifier: Apache-2.0
// bench_glb DIR...: bytes of GLB files at equal error on the screen. Of each program's meshes the
// one of the fewest triangles counts whose picture is as good as that of meshoptimizer's mesh of a
// budget; all are written by the same code, plain and compressed, with normals and texture
// coordinates, without the texture.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <optional>

#include "apps/tools/files/meshes/mesh_writers.hpp"
#include "apps/tools/files/stream.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/results.hpp"
#include "bench/meshes/decimation_peers.hpp"
#include "bench/meshes/screen.hpp"
#include "bench/meshes/screen_terrain.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;

constexpr std::array<uint32_t, 3> kGoals = {2000, 10000, 40000};
constexpr double kStep = 1.2;  ///< between the budgets that are tried
constexpr uint32_t kLeast = 1000, kMost = 110000;
/// Martini cannot do more.
constexpr uint32_t kSide = 1025;

struct Options {
  std::vector<std::string> folders, filters;
  std::string node = "build/decimation-node", csv;
};

std::vector<uint32_t> allBudgets(size_t samples) {
  std::vector<uint32_t> budgets;
  for (double b = kLeast; b < std::min<double>(kMost, 2.0 * static_cast<double>(samples));
       b *= kStep)
    budgets.push_back(static_cast<uint32_t>(b));
  return budgets;
}

/// The central square that Martini can do, and the texture over it.
void cutToSquare(ScreenTerrain& terrain) {
  const Raster& whole = terrain.raster;
  uint32_t side = kSide;
  while (side > std::min(whole.width, whole.height)) side = side / 2 + 1;
  const auto part = [side](uint32_t samples, uint32_t texels) {
    const double share = (side - 1.0) / std::max(samples - 1.0, 1.0);
    const auto kept = static_cast<uint32_t>(std::lround(share * texels));
    return std::pair((texels - kept) / 2, kept);
  };
  tools::ImageFile& image = terrain.texture;
  const auto [left, width] = part(whole.width, image.width);
  const auto [top, height] = part(whole.height, image.height);
  const size_t pixel = image.data.size() / (size_t{image.width} * image.height);
  std::vector<std::byte> texels;
  for (uint32_t y = top; y < top + height; ++y) {
    const auto row =
        image.data.begin() + static_cast<std::ptrdiff_t>((size_t{y} * image.width + left) * pixel);
    texels.insert(texels.end(), row, row + static_cast<std::ptrdiff_t>(width * pixel));
  }
  image.data = std::move(texels);
  image.width = width;
  image.height = height;
  terrain.raster = mirrorTo(whole, side, side);
  terrain.frame.width = terrain.frame.height = side;
}

/// Triangles counter-clockwise seen from above.
void turnUp(tools::MeshFile& mesh) {
  const auto& p = mesh.positions;
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const size_t a = 3 * mesh.triangles[i], b = 3 * mesh.triangles[i + 1],
                 c = 3 * mesh.triangles[i + 2];
    const float area =
        (p[b] - p[a]) * (p[c + 2] - p[a + 2]) - (p[b + 2] - p[a + 2]) * (p[c] - p[a]);
    if (area > 0) std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);
  }
}

using MeshOf = std::function<Result<tools::MeshFile>(uint32_t budget)>;

class Comparison {
 public:
  Comparison(const ScreenTerrain& terrain, Screen& screen, std::vector<ResultRow>& rows)
      : terrain_(terrain),
        screen_(screen),
        rows_(rows),
        budgets_(allBudgets(terrain.raster.pixels())) {}

  Status run(const std::string& node) {
    if (const Status status = addPeers(node); !status.ok()) return status;
    tks_encode_options lossless = makeEncodeOptions();
    lossless.lossless = 1;
    const Result<Buffer> exact = encodeHeights(terrain_.raster, lossless);
    tks_encode_options half = makeEncodeOptions();
    half.bytes = terrain_.raster.pixels() / 2;
    const Result<Buffer> stream = encodeHeights(terrain_.raster, half);
    if (!exact || !stream) return (exact ? stream : exact).status();
    Result<Decoder> decoder = tools::openDecoder(exact->bytes());
    if (!decoder) return decoder.status();
    const std::vector<tks_screen_camera> cameras = screen_.meshCameras();
    programs_["tetrakis"] = ours([&](uint32_t n) { return decoder->budgetMesh(n); });
    programs_["tetrakis, cameras"] =
        ours([&](uint32_t n) { return decoder->screenMesh(cameras, n); });
    for (const uint32_t budget : kGoals) {
      const auto peer = programs_["meshoptimizer"](budget);
      if (!peer.ok()) return peer.status();
      const auto goal = scoreOf(*peer);
      if (!goal.ok()) return goal.status();
      std::printf("  as good as meshoptimizer's %u triangles: %.2f dB\n", budget, *goal);
      if (const Status status = compare(budget, *goal, stream->bytes()); !status.ok())
        return status;
    }
    return {};
  }

 private:
  Status addPeers(const std::string& node) {
    auto peers = nodeMeshes(terrain_.raster, node, budgets_);
    if (!peers.ok()) return peers.status();
    for (PeerMesh& peer : *peers)
      meshes_[peer.peer].emplace(peer.budget, placed(peer.mesh, terrain_.frame));
    for (auto& item : meshes_) {
      auto& kept = item.second;
      for (auto& mesh : kept) turnUp(mesh.second);
      programs_[item.first] = [&kept](uint32_t n) -> Result<tools::MeshFile> { return kept.at(n); };
    }
    const double spacing = 0.5 * (terrain_.frame.spacing_x + terrain_.frame.spacing_y);
    simplifier_.emplace(terrain_.raster, terrain_.frame.metres_per_unit / spacing);
    programs_["meshoptimizer"] = [this](uint32_t n) -> Result<tools::MeshFile> {
      tools::MeshFile mesh = placed(simplifier_->run(n), terrain_.frame);
      turnUp(mesh);
      return mesh;
    };
    return {};
  }

  MeshOf ours(std::function<Result<Mesh>(uint32_t)> make) const {
    return [this, make = std::move(make)](uint32_t n) -> Result<tools::MeshFile> {
      const Result<Mesh> mesh = make(n);
      if (!mesh) return mesh.status();
      return tools::placeMesh(*mesh, terrain_.frame);
    };
  }

  Result<double> scoreOf(const tools::MeshFile& mesh) {
    const auto psnr = screen_.score(mesh);
    if (!psnr.ok()) return psnr.status();
    return (*psnr)[0];
  }

  /// The mesh of the smallest budget, by halving, whose picture reaches the goal; none: no mesh of
  /// the largest does.
  Result<std::optional<tools::MeshFile>> smallest(const MeshOf& make, double goal) {
    size_t low = 0, high = budgets_.size();
    std::optional<tools::MeshFile> best;
    while (low < high) {
      const size_t middle = (low + high) / 2;
      Result<tools::MeshFile> mesh = make(budgets_[middle]);
      if (!mesh.ok()) return mesh.status();
      const auto score = scoreOf(*mesh);
      if (!score.ok()) return score.status();
      if (*score >= goal) {
        best = std::move(*mesh);
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    return best;
  }

  Status compare(uint32_t budget, double goal, std::span<const uint8_t> stream) {
    uint32_t triangles = 0;
    for (const auto& item : programs_) {
      const auto found = smallest(item.second, goal);
      if (!found.ok()) return found.status();
      if (!*found) {
        std::printf("  %-18s none\n", item.first.c_str());
        continue;
      }
      const auto count = static_cast<uint32_t>((*found)->triangles.size() / 3);
      if (item.first == "tetrakis") triangles = count;
      std::printf("  %-18s %6u triangles", item.first.c_str(), count);
      if (const Status status = addFiles(budget, item.first, **found); !status.ok()) return status;
    }
    return triangles == 0 ? Status() : addStream(budget, goal, 2 * triangles, stream);
  }

  Status addFiles(uint32_t budget, const std::string& program, const tools::MeshFile& mesh) {
    using Compression = tools::MeshCompression;
    for (const auto& [name, compression] : {std::pair("plain", Compression::kNone),
                                            {"meshopt", Compression::kMeshopt},
                                            {"draco", Compression::kDraco}}) {
      const auto glb = tools::encodeGlb(mesh, {compression, tools::MeshTexture::kChosen});
      if (!glb.ok()) return glb.status();
      std::printf("  %s %8.1f kB", name, 1e-3 * static_cast<double>(glb->size()));
      add(budget, program, name, glb->size());
    }
    std::printf("\n");
    std::fflush(stdout);
    return {};
  }

  /// The shortest prefix, to 1 %, of which a mesh of so many triangles reaches the goal.
  Status addStream(uint32_t budget, double goal, uint32_t triangles,
                   std::span<const uint8_t> stream) {
    size_t low = 0, high = stream.size() + 1;
    while (high - low > 1 + high / 100) {
      const size_t middle = (low + high) / 2;
      Result<Decoder> decoder = Decoder::open(stream.first(middle));
      if (!decoder) {
        low = middle;
        continue;
      }
      const auto mesh = ours([&](uint32_t n) { return decoder->budgetMesh(n); })(triangles);
      if (!mesh.ok()) return mesh.status();
      const auto score = scoreOf(*mesh);
      if (!score.ok()) return score.status();
      (*score >= goal ? high : low) = middle;
    }
    if (high > stream.size()) {
      std::printf("  %-18s none\n", ".tks");
      return {};
    }
    std::printf("  %-18s %6u triangles  %.1f kB\n", ".tks", triangles,
                1e-3 * static_cast<double>(high));
    add(budget, "tks", "stream", high);
    return {};
  }

  void add(uint32_t budget, const std::string& program, const std::string& form, size_t bytes) {
    rows_.push_back({terrain_.item, program, form + "_bytes_at_" + std::to_string(budget),
                     static_cast<double>(bytes)});
  }

  const ScreenTerrain& terrain_;
  Screen& screen_;
  std::vector<ResultRow>& rows_;
  std::vector<uint32_t> budgets_;
  std::map<std::string, std::map<uint32_t, tools::MeshFile>> meshes_;  ///< by program, budget
  std::optional<Simplifier> simplifier_;
  std::map<std::string, MeshOf> programs_;
};

Status run(const Options& options) {
  const std::vector<TerrainFiles> terrains = texturedTerrains(options.folders, options.filters);
  if (terrains.empty()) return {TKS_IO, "No folder holds height.* and texture.*."};
  std::vector<ResultRow> rows;
  for (const TerrainFiles& files : terrains) {
    Result<ScreenTerrain> terrain = loadTerrain(files);
    if (!terrain.ok()) return terrain.status();
    cutToSquare(*terrain);
    std::printf("%s, %u x %u\n", terrain->item.c_str(), terrain->raster.width,
                terrain->raster.height);
    Result<Screen> screen = Screen::create(terrain->surface(), terrain->frame, terrain->texture);
    if (!screen.ok()) return screen.status();
    if (Status status = Comparison(*terrain, *screen, rows).run(options.node); !status.ok())
      return status;
  }
  return updateResults(options.csv, "glb", rows);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Arguments arguments("Bytes of GLB files at equal error on the screen");
  arguments.folders(options.folders, options.filters);
  arguments.text({"--node", "Folder with the npm packages of Martini and Delatin"}, options.node);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return exitCode(run(options));
}
