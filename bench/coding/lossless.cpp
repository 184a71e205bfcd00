// SPDX-License-Identifier: Apache-2.0
// bench_lossless DIR...: bytes of height files as they are, of every type, coded to the last bit:
// beside GeoTIFF by GDAL with every compression and predictor at its best level, and beside JPEG XL
// at effort 9, where samples are integers of at most 16 bits.
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <span>

#include "apps/tools/files/files.hpp"
#include "base/samples.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/height_files.hpp"
#include "bench/harness/results.hpp"
#include "bench/peers/program.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {
namespace {

struct Options {
  std::vector<std::string> folders, filters;
  std::string csv;
};

/// Bytes of a codec; 0: it does not take such a file.
struct Sizes {
  uint64_t tetrakis = 0, geotiff = 0, jxl = 0;
  std::string best_geotiff;  ///< its compression and predictor

  uint64_t best() const { return jxl > 0 ? std::min(geotiff, jxl) : geotiff; }
};

Result<uint64_t> withTetrakis(const tools::HeightFile& file) {
  tks_heights heights = makeHeights();
  heights.width = file.width;
  heights.height = file.height;
  heights.sample = file.sample;
  heights.data = file.data.data();
  heights.has_nodata = file.nodata.has_value();
  heights.nodata = file.nodata.value_or(0);
  tks_encode_options options = makeEncodeOptions();
  options.lossless = 1;
  const Result<Buffer> stream = encode(&heights, nullptr, options);
  if (!stream.ok()) return stream.status();
  return uint64_t{stream->bytes().size()};
}

/// Options of GDAL's GeoTIFF driver.
struct GeotiffCoding {
  const char *name, *compression, *level;
  bool predicts;
};
constexpr GeotiffCoding kGeotiffCodings[] = {
    {"deflate", "COMPRESS=DEFLATE", "ZLEVEL=9", true},
    {"zstd", "COMPRESS=ZSTD", "ZSTD_LEVEL=22", true},
    {"lerc_deflate", "COMPRESS=LERC_DEFLATE", "ZLEVEL=9", false},
    {"lerc_zstd", "COMPRESS=LERC_ZSTD", "ZSTD_LEVEL=22", false}};

/// The smallest GeoTIFF of any coding. Predictor 2 takes differences, 3 those of the bytes of
/// floats. Strips of 512 rows: GDAL's default of 8 kB costs all of them bytes.
Status addGeotiff(const std::string& path, bool floats, const TemporaryFolder& folder,
                  Sizes& sizes) {
  sizes.geotiff = std::numeric_limits<uint64_t>::max();
  const std::string out = folder.file("coded.tif");
  for (const GeotiffCoding& coding : kGeotiffCodings) {
    const int most = !coding.predicts ? 1 : floats ? 3 : 2;
    for (int predictor = 1; predictor <= most; ++predictor) {
      std::vector<std::string> words = {"gdal_translate", "-q",  "-of",
                                        "GTiff",          "-co", "BLOCKYSIZE=512"};
      words.insert(words.end(), {"-co", coding.compression, "-co", coding.level});
      const std::string number = std::to_string(predictor);
      if (coding.predicts) words.insert(words.end(), {"-co", "PREDICTOR=" + number});
      words.insert(words.end(), {path, out});
      const Status status = runProgram(words, folder.file("log"));
      if (!status.ok()) return status;
      const uint64_t bytes = std::filesystem::file_size(out);
      if (bytes >= sizes.geotiff) continue;
      sizes.geotiff = bytes;
      sizes.best_geotiff = coding.name + (coding.predicts ? "_" + number : std::string());
    }
  }
  return {};
}

/// Integers of 16 bits at most, less the smallest of their type, as an image.
tools::ImageFile imageOf(const tools::HeightFile& file) {
  tools::ImageFile image{file.width, file.height, 1, TKS_U16, {}};
  withSampleType(file.sample, [&](auto type) {
    using T = decltype(type);
    if (sizeof(T) == 1) image.sample = TKS_U8;
    for (size_t i = 0; i < size_t{file.width} * file.height; ++i) {
      T sample;
      std::memcpy(&sample, file.data.data() + i * sizeof sample, sizeof sample);
      const auto whole =
          static_cast<int32_t>(sample) - static_cast<int32_t>(std::numeric_limits<T>::lowest());
      const auto word = static_cast<uint16_t>(whole);
      const auto bytes = std::as_bytes(std::span(&word, 1));
      image.data.insert(image.data.end(), bytes.begin(),
                        bytes.begin() + static_cast<ptrdiff_t>(tks_sample_bytes(image.sample)));
    }
  });
  return image;
}

Status addJxl(const tools::HeightFile& file, const TemporaryFolder& folder, Sizes& sizes) {
  if (tks_sample_bytes(file.sample) > 2) return {};
  const std::string in = folder.file("in.png"), out = folder.file("coded.jxl");
  if (Status status = tools::writeImage(in, imageOf(file)); !status.ok()) return status;
  const Status status =
      runProgram({"cjxl", "--num_threads=0", "-e", "9", "-d", "0", in, out}, folder.file("log"));
  if (status.ok()) sizes.jxl = std::filesystem::file_size(out);
  return status;
}

Result<Sizes> sizesOf(const std::string& path, const tools::HeightFile& file) {
  const TemporaryFolder folder;
  if (!folder.made()) return Status(TKS_IO, "Cannot make a temporary folder: is the disk full?");
  Sizes sizes;
  const Result<uint64_t> ours = withTetrakis(file);
  if (!ours.ok()) return ours.status();
  sizes.tetrakis = *ours;
  Status status = addGeotiff(path, file.sample == TKS_F32, folder, sizes);
  if (status.ok()) status = addJxl(file, folder, sizes);
  if (!status.ok()) return status;
  return sizes;
}

/// Of all files of a kind.
struct Mean {
  double sum = 0;
  int files = 0;

  void print(const char* kind) const {
    if (files > 0)
      std::printf("mean of %d %s files: %.3f of the best peer\n", files, kind, sum / files);
  }
};

class Run {
 public:
  Status measure(const std::string& path, const std::string& item) {
    const Result<tools::HeightFile> file = tools::readHeights(path);
    if (!file.ok()) return file.status();
    const Result<Sizes> sizes = sizesOf(path, *file);
    if (!sizes.ok()) return sizes.status();
    report(item, file->sample, *sizes);
    return {};
  }

  void printMeans() const {
    floats_.print("float");
    integers_.print("integer");
  }

  const std::vector<ResultRow>& rows() const { return rows_; }

 private:
  void report(const std::string& item, tks_sample sample, const Sizes& sizes) {
    const double ratio = static_cast<double>(sizes.tetrakis) / static_cast<double>(sizes.best());
    Mean& mean = sample == TKS_F32 ? floats_ : integers_;
    mean.sum += ratio;
    ++mean.files;
    std::printf("%-28s %10llu %10llu %-12s %10llu %7.3f\n", item.c_str(),
                static_cast<unsigned long long>(sizes.tetrakis),
                static_cast<unsigned long long>(sizes.geotiff), sizes.best_geotiff.c_str(),
                static_cast<unsigned long long>(sizes.jxl), ratio);
    std::fflush(stdout);
    const auto row = [&](const char* codec, uint64_t bytes) {
      if (bytes > 0)
        rows_.push_back({item, codec, "lossless_file_bytes", static_cast<double>(bytes)});
    };
    row("tetrakis", sizes.tetrakis);
    row("geotiff_best", sizes.geotiff);
    row("jxl_e9", sizes.jxl);
  }

  std::vector<ResultRow> rows_;
  Mean floats_, integers_;
};

int run(const Options& options) {
  Run run;
  std::printf("%-28s %10s %10s %-12s %10s %7s\n", "file", "tetrakis", "geotiff", "coding", "jxl_e9",
              "ratio");
  const bool all = measureHeightFiles(
      options.folders, options.filters,
      [&](const std::string& path, const std::string& item) { return run.measure(path, item); });
  run.printMeans();
  if (!all) return 1;
  return exitCode(updateResults(options.csv, "lossless", run.rows()));
}

}  // namespace
}  // namespace tetrakis::bench

int main(int argc, char** argv) {
  tetrakis::bench::Options options;
  tetrakis::bench::Arguments arguments("Lossless height files, beside GeoTIFF and JPEG XL");
  arguments.folders(options.folders, options.filters);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return tetrakis::bench::run(options);
}
