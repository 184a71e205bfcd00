// SPDX-License-Identifier: Apache-2.0
// bench_geometry DIR...: height fields. One Tetrakis stream, cut, against OpenJPEG 9/7 files made
// for each rate (the better of 6 and 9 resolutions, heights as they are or stretched to 16 bits).
// Lossless also against JPEG XL.
#include "bench/comparison.hpp"
#include "bench/jxl_peer.hpp"
#include "bench/openjpeg_peer.hpp"
#include "bench/options.hpp"
#include "bench/tetrakis_peer.hpp"
#include "tools/files.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;

Result<Raster> load(const std::string& path) {
  const Result<tools::HeightFile> file = tools::readHeights(path);
  if (!file.ok()) return file.status();
  return heightRaster(*file);
}

}  // namespace

int main(int argc, char** argv) {
  ComparisonOptions options;
  options.window = {0.05, 2};
  CLI::App app("Rate against error of height fields, beside OpenJPEG 9/7");
  addComparisonOptions(app, options);
  app.add_option("--peers", options.peers, "More codecs: jxl (lossless)")
      ->delimiter(',')
      ->check(CLI::IsMember({"jxl"}));
  CLI11_PARSE(app, argc, argv);

  ComparisonSpec spec;
  spec.bench = "geometry";
  spec.extensions = {".tif", ".tiff", ".hgt", ".exr"};
  spec.wanted = [](const std::string& stem) { return stem != "texture"; };
  spec.load = load;
  spec.report_rmse = true;
  spec.peers.push_back(std::make_unique<OpenJpegPeer>(std::vector{6, 9}, true));
  spec.peers.push_back(std::make_unique<TetrakisPeer>(RasterKind::kHeights));
  if (options.wants("jxl")) {
    addInstalled(std::make_unique<JxlPeer>(JxlModes::kLossless), spec.peers);
  }
  return runComparison(spec, options);
}
