// SPDX-License-Identifier: Apache-2.0
// bench_geometry DIR...: height fields. One Tetrakis stream, cut, against OpenJPEG 9/7 files made
// for each rate (the better of 6 and 9 resolutions, heights as they are or stretched to 16 bits).
// Lossless also against JPEG XL.
#include "apps/tools/files/files.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/comparison.hpp"
#include "bench/peers/jxl_peer.hpp"
#include "bench/peers/openjpeg_peer.hpp"
#include "bench/peers/tetrakis_peer.hpp"

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
  Arguments arguments("Rate against error of height fields, beside OpenJPEG 9/7");
  arguments.comparison(options);
  arguments.choices({"--peers", "More codecs: jxl (lossless)"}, options.peers, {"jxl"});
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;

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
