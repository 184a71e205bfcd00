// SPDX-License-Identifier: Apache-2.0
// bench_screen_mesh DIR...: textured terrain drawn with few triangles, beside meshoptimizer.
// Folders below DIR that hold height.* and texture.* are a terrain each; what the meshes lack is
// measured on the screen, against the full grid with the same texture.
#include <array>
#include <cstdio>
#include <ctime>
#include <functional>

#include "apps/tools/files/stream.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/results.hpp"
#include "bench/meshes/decimation_peers.hpp"
#include "bench/meshes/screen.hpp"
#include "bench/meshes/screen_terrain.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;

constexpr std::array<uint32_t, 3> kBudgets = {2000, 10000, 50000};

struct Options {
  std::vector<std::string> folders, filters;
  std::string csv;
};

class Comparison {
 public:
  Comparison(const ScreenTerrain& terrain, Screen& screen, std::vector<ResultRow>& rows)
      : terrain_(terrain), screen_(screen), rows_(rows) {}

  Status run() {
    tks_encode_options options = makeEncodeOptions();
    options.lossless = 1;
    const Result<Buffer> stream = encodeHeights(terrain_.raster, options);
    if (!stream) return stream.status();
    Result<Decoder> decoder = tools::openDecoder(stream->bytes());
    if (!decoder) return decoder.status();
    tks_image texture = makeImage();
    texture.width = terrain_.texture.width;
    texture.height = terrain_.texture.height;
    texture.channels = terrain_.texture.channels;
    texture.sample = terrain_.texture.sample;
    texture.data = terrain_.texture.data.data();
    const std::vector<tks_screen_camera> cameras = screen_.meshCameras();
    const std::vector<tks_screen_camera> any = screen_.anyCameras();
    const double spacing = 0.5 * (terrain_.frame.spacing_x + terrain_.frame.spacing_y);
    const Simplifier simplifier(terrain_.raster, terrain_.frame.metres_per_unit / spacing);
    for (const uint32_t budget : kBudgets) {
      if (budget > terrain_.raster.pixels()) continue;
      budget_ = budget;
      const auto peer = [&] { return placed(simplifier.run(budget), terrain_.frame); };
      Status status = add("meshoptimizer", [&] { return Result<tools::MeshFile>(peer()); });
      if (status.ok()) status = ours("budget", [&] { return decoder->budgetMesh(budget); });
      if (status.ok()) status = ours("turned", [&] { return decoder->screenMesh({}, budget); });
      if (status.ok())
        status = ours("any+texture", [&] { return decoder->screenMesh(any, budget, &texture); });
      if (status.ok())
        status = ours("cameras", [&] { return decoder->screenMesh(cameras, budget); });
      if (status.ok())
        status =
            ours("cameras+texture", [&] { return decoder->screenMesh(cameras, budget, &texture); });
      if (!status.ok()) return status;
    }
    return {};
  }

 private:
  Status ours(const std::string& name, const std::function<Result<Mesh>()>& make) {
    return add("tetrakis_" + name, [&]() -> Result<tools::MeshFile> {
      const Result<Mesh> mesh = make();
      if (!mesh) return mesh.status();
      return tools::placeMesh(*mesh, terrain_.frame);
    });
  }

  Status add(const std::string& codec, const std::function<Result<tools::MeshFile>()>& make) {
    const std::clock_t start = std::clock();
    const Result<tools::MeshFile> mesh = make();
    const double ms = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (!mesh.ok()) return mesh.status();
    const auto psnr = screen_.score(*mesh);
    if (!psnr.ok()) return psnr.status();
    std::printf("  %-24s %6zu triangles  %6.2f dB  (oblique %.2f, low %.2f, top %.2f)  %.0f ms\n",
                codec.c_str(), mesh->triangles.size() / 3, (*psnr)[0], (*psnr)[1], (*psnr)[2],
                (*psnr)[3], ms);
    std::fflush(stdout);
    rows_.push_back(
        {terrain_.item, codec, "screen_psnr_at_" + std::to_string(budget_), (*psnr)[0]});
    return {};
  }

  const ScreenTerrain& terrain_;
  Screen& screen_;
  std::vector<ResultRow>& rows_;
  uint32_t budget_ = 0;
};

Status run(const Options& options) {
  const std::vector<TerrainFiles> terrains = texturedTerrains(options.folders, options.filters);
  if (terrains.empty()) return {TKS_IO, "No folder holds height.* and texture.*."};
  std::vector<ResultRow> rows;
  for (const TerrainFiles& files : terrains) {
    const Result<ScreenTerrain> terrain = loadTerrain(files);
    if (!terrain.ok()) return terrain.status();
    std::printf("%s, %u x %u\n", terrain->item.c_str(), terrain->raster.width,
                terrain->raster.height);
    Result<Screen> screen = Screen::create(terrain->surface(), terrain->frame, terrain->texture);
    if (!screen.ok()) return screen.status();
    if (Status status = Comparison(*terrain, *screen, rows).run(); !status.ok()) return status;
  }
  return updateResults(options.csv, "screen_mesh", rows);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Arguments arguments("Textured terrain drawn with few triangles, beside meshoptimizer");
  arguments.folders(options.folders, options.filters);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return exitCode(run(options));
}
