// SPDX-License-Identifier: Apache-2.0
// bench_visual IMAGE...: what `--weights visual` gains in MS-SSIM and costs in PSNR, at equal
// bytes.
#include <cmath>
#include <cstdio>

#include "apps/tools/files/files.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/ms_ssim.hpp"
#include "bench/harness/results.hpp"
#include "bench/peers/tetrakis_peer.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;

constexpr double kRates[] = {0.25, 0.5, 1};  // bits a pixel

struct Options {
  std::vector<std::string> images;
  uint64_t max_pixels = uint64_t{1024} * 1024;
  std::string csv;
};

struct Quality {
  double psnr = 0, similarity = 0;  ///< dB; similarity: of MS-SSIM, -10 log10(1 - x)
};

Result<Quality> qualityAt(const Raster& image, double rate, tks_weights weights) {
  const auto bytes = static_cast<uint64_t>(rate * static_cast<double>(image.pixels()) / 8);
  const auto stream = encodeTetrakis({nullptr, &image, weights}, bytes);
  if (!stream.ok()) return stream.status();
  const auto decoded = decodeTetrakis(*stream);
  if (!decoded.ok()) return decoded.status();
  return Quality{10 * std::log10(255 * 255 / meanSquaredError(image, decoded->image)),
                 -10 * std::log10(1 - msSsim(image, decoded->image))};
}

Status compareImage(const std::string& path, const Options& options, std::vector<ResultRow>& rows) {
  const auto file = tools::readImage(path);
  if (!file.ok()) return file.status();
  const Raster image = cropCentre(imageRaster(*file), options.max_pixels);
  const std::string name = path.substr(path.find_last_of('/') + 1);
  const std::string item = name.substr(0, name.find_last_of('.'));
  std::printf("%s  %u x %u\n  %8s %21s %21s\n", item.c_str(), image.width, image.height, "bits",
              "PSNR psnr / visual", "MS-SSIM psnr / visual");
  for (const double rate : kRates) {
    const auto plain = qualityAt(image, rate, TKS_WEIGHTS_PSNR);
    if (!plain.ok()) return plain.status();
    const auto visual = qualityAt(image, rate, TKS_WEIGHTS_VISUAL);
    if (!visual.ok()) return visual.status();
    std::printf("  %8g %9.2f / %9.2f %9.2f / %9.2f dB\n", rate, plain->psnr, visual->psnr,
                plain->similarity, visual->similarity);
    char quantity[32];
    std::snprintf(quantity, sizeof quantity, "psnr_gain_at_%g", rate);
    rows.push_back({item, "tetrakis", quantity, visual->psnr - plain->psnr});
    std::snprintf(quantity, sizeof quantity, "ms_ssim_gain_at_%g", rate);
    rows.push_back({item, "tetrakis", quantity, visual->similarity - plain->similarity});
  }
  return {};
}

Status run(const Options& options) {
  std::vector<ResultRow> rows;
  for (const std::string& path : options.images) {
    const Status status = compareImage(path, options, rows);
    if (!status.ok()) return status;
  }
  return updateResults(options.csv, "visual", rows);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Arguments arguments("MS-SSIM and PSNR of textures with visual weights and without");
  arguments.required({"IMAGE", "Images"}, options.images);
  arguments.maxPixels(options.max_pixels);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return exitCode(run(options));
}
