// SPDX-License-Identifier: Apache-2.0
// bench_texture DIR...: images. One Tetrakis stream, cut, against OpenJPEG 9/7 files made for each
// rate, and AVIF and JPEG XL files. PSNR of the mean squared error over the channels, 8 bits.
#include "apps/tools/files/files.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/comparison.hpp"
#include "bench/peers/avif_peer.hpp"
#include "bench/peers/jxl_peer.hpp"
#include "bench/peers/openjpeg_peer.hpp"
#include "bench/peers/tetrakis_peer.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;

Result<Raster> load(const std::string& path, uint64_t max_pixels) {
  const Result<tools::ImageFile> file = tools::readImage(path);
  if (!file.ok()) return file.status();
  return cropCentre(imageRaster(*file), max_pixels);
}

}  // namespace

int main(int argc, char** argv) {
  ComparisonOptions options;
  options.window = {0.1, 2};
  uint64_t max_pixels = uint64_t{2048} * 2048;
  Arguments arguments("Rate against PSNR of images, beside OpenJPEG 9/7");
  arguments.comparison(options);
  arguments.maxPixels(max_pixels);
  arguments.choices({"--peers", "More codecs: avif (at two speeds), jxl"}, options.peers,
                    {"avif", "jxl"});
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;

  ComparisonSpec spec;
  spec.bench = "texture";
  spec.extensions = {".png", ".tif", ".tiff", ".jpg", ".jpeg"};
  spec.wanted = [](const std::string& stem) { return stem != "height"; };
  spec.load = [max_pixels](const std::string& path) { return load(path, max_pixels); };
  spec.peers.push_back(std::make_unique<OpenJpegPeer>(std::vector{6}, false));
  spec.peers.push_back(std::make_unique<TetrakisPeer>(RasterKind::kImage));
  if (options.wants("avif")) {
    for (const int speed : {3, 6}) {
      addInstalled(std::make_unique<AvifPeer>(speed), spec.peers);
    }
  }
  if (options.wants("jxl")) {
    addInstalled(std::make_unique<JxlPeer>(JxlModes::kLosslessAndLossy), spec.peers);
  }
  return runComparison(spec, options);
}
