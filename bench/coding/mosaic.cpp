// SPDX-License-Identifier: Apache-2.0
// bench_mosaic DIR...: heights that are coded tile by tile, by tasks that share nothing but files,
// beside an encoder that holds the plane: bytes to the last bit and within a largest error, error
// at equal bytes, and processor time. Both have regions of the same side.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "base/samples.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/height_files.hpp"
#include "bench/harness/results.hpp"
#include "tetrakis/mosaic.h"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {
namespace {

constexpr uint32_t kRegions = 128, kTile = 512;

double processorSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// A source, the parts of its mosaic and its stream, in memory.
struct Mosaic {
  const tks_heights& heights;
  std::map<std::string, std::vector<uint8_t>> files{};
  std::vector<uint8_t> stream{};

  static int readWindow(void* user, const tks_window* window, void* samples) {
    const tks_heights& from = static_cast<Mosaic*>(user)->heights;
    const size_t sample = tks_sample_bytes(from.sample), row = window->width * sample;
    for (uint32_t y = 0; y < window->height; ++y) {
      const size_t first = size_t{window->y + y} * from.width + window->x;
      std::memcpy(static_cast<std::byte*>(samples) + y * row,
                  static_cast<const std::byte*>(from.data) + first * sample, row);
    }
    return 0;
  }
  static int readFile(void* user, const char* name, uint64_t offset, uint64_t bytes, void* out,
                      uint64_t* read) {
    const auto& files = static_cast<Mosaic*>(user)->files;
    const auto found = files.find(name);
    if (found == files.end() || offset > found->second.size()) return 1;
    *read = std::min<uint64_t>(bytes, found->second.size() - offset);
    std::memcpy(out, found->second.data() + offset, *read);
    return 0;
  }
  static int sizeOf(void* user, const char* name, uint64_t* size) {
    const auto& files = static_cast<Mosaic*>(user)->files;
    const auto found = files.find(name);
    if (found == files.end()) return 1;
    *size = found->second.size();
    return 0;
  }
  static int writeFile(void* user, const char* name, const void* data, size_t size) {
    const auto* bytes = static_cast<const uint8_t*>(data);
    static_cast<Mosaic*>(user)->files[name].assign(bytes, bytes + size);
    return 0;
  }
  static int writeAt(void* user, uint64_t offset, const void* data, size_t size) {
    auto& stream = static_cast<Mosaic*>(user)->stream;
    stream.resize(std::max<size_t>(stream.size(), offset + size));
    std::memcpy(stream.data() + offset, data, size);
    return 0;
  }
};

struct Coded {
  std::vector<uint8_t> stream;
  double seconds = 0;
};

Result<Coded> byMosaic(const tks_heights& heights, tks_mosaic_options options) {
  options.size = sizeof options;
  options.regions = kRegions;
  options.tile = kTile;
  Mosaic mosaic{heights};
  const tks_mosaic_source source{sizeof source, &heights, Mosaic::readWindow, &mosaic};
  const tks_mosaic_files files{sizeof files, Mosaic::readFile, Mosaic::sizeOf, Mosaic::writeFile,
                               &mosaic};
  char message[512] = "";
  const double begin = processorSeconds();
  tks_buffer plan = {};
  tks_status status = tks_mosaic_plan(&source, &options, &plan, message, sizeof message);
  if (status != TKS_OK) return Status(status, message);
  size_t count = 0;
  tks_mosaic_tiles(plan.data, plan.size, nullptr, 0, &count);
  std::vector<tks_tile> tiles(count);
  tks_mosaic_tiles(plan.data, plan.size, tiles.data(), count, &count);
  for (size_t i = 0; i < count && status == TKS_OK; ++i) {
    status = tks_mosaic_code(plan.data, plan.size, tiles[i], &source, &files, 1, message,
                             sizeof message);
  }
  if (status == TKS_OK) {
    status = tks_mosaic_merge(plan.data, plan.size, &files, nullptr, Mosaic::writeAt, &mosaic,
                              message, sizeof message);
  }
  tks_free_buffer(&plan);
  if (status != TKS_OK) return Status(status, message);
  return Coded{std::move(mosaic.stream), processorSeconds() - begin};
}

Result<Coded> byEncoder(const tks_heights& heights, tks_encode_options options) {
  options.regions = kRegions;
  options.threads = 1;
  const double begin = processorSeconds();
  const Result<Buffer> stream = encode(&heights, nullptr, options);
  if (!stream.ok()) return stream.status();
  const auto bytes = stream->bytes();
  return Coded{{bytes.begin(), bytes.end()}, processorSeconds() - begin};
}

/// Root of the mean squared error of the samples, voids left out.
double rmseOf(const Coded& coded, const tools::HeightFile& truth) {
  Result<Decoder> decoder = Decoder::open(coded.stream);
  if (!decoder.ok()) return NAN;
  const Result<std::vector<std::byte>> decoded = decoder->heights();
  if (!decoded.ok()) return NAN;
  return withSampleType(truth.sample, [&](auto type) {
    using T = decltype(type);
    double squares = 0, count = 0;
    for (size_t i = 0; i < truth.data.size() / sizeof(T); ++i) {
      T a{}, b{};
      std::memcpy(&a, truth.data.data() + i * sizeof a, sizeof a);
      std::memcpy(&b, decoded->data() + i * sizeof b, sizeof b);
      const auto value = static_cast<double>(a);
      if (std::isnan(value) || (truth.nodata && value == *truth.nodata)) continue;
      squares += (value - static_cast<double>(b)) * (value - static_cast<double>(b));
      ++count;
    }
    return std::sqrt(squares / std::max(1., count));
  });
}

class Run {
 public:
  Status measure(const std::string& path, const std::string& item) {
    const Result<tools::HeightFile> file = tools::readHeights(path);
    if (!file.ok()) return file.status();
    const tks_heights heights = tools::asHeights(*file);
    std::printf("%-28s", item.c_str());
    tks_mosaic_options options = {};
    tks_encode_options encoding = makeEncodeOptions();
    options.lossless = encoding.lossless = 1;
    compareBytes(heights, options, encoding, item, "lossless");
    options = {};
    encoding = makeEncodeOptions();
    options.max_error = encoding.max_error = std::abs(file->scale);
    compareBytes(heights, options, encoding, item, "within_1");
    for (const double bits : {0.1, 0.5, 2.0}) {
      const double samples = static_cast<double>(file->width) * file->height;
      options = {};
      encoding = makeEncodeOptions();
      options.bytes = encoding.bytes = static_cast<uint64_t>(bits * samples / 8);
      compareErrors(heights, *file, options, encoding, item, bits);
    }
    std::printf("\n");
    std::fflush(stdout);
    return {};
  }

  const std::vector<ResultRow>& rows() const { return rows_; }

 private:
  void add(const std::string& item, const std::string& quantity, double ratio) {
    std::printf(" %8.4f", ratio);
    rows_.push_back({item, "tetrakis_mosaic", quantity, ratio});
  }

  /// Nothing where a mosaic cannot keep the promise.
  void compareBytes(const tks_heights& heights, const tks_mosaic_options& options,
                    const tks_encode_options& encoding, const std::string& item,
                    const std::string& target) {
    const Result<Coded> mosaic = byMosaic(heights, options), whole = byEncoder(heights, encoding);
    if (!mosaic.ok() || !whole.ok()) {
      std::printf(" %8s %8s", "-", "-");
      return;
    }
    add(item, target + "_bytes_ratio",
        static_cast<double>(mosaic->stream.size()) / static_cast<double>(whole->stream.size()));
    add(item, target + "_processor_ratio", mosaic->seconds / whole->seconds);
  }

  void compareErrors(const tks_heights& heights, const tools::HeightFile& file,
                     const tks_mosaic_options& options, const tks_encode_options& encoding,
                     const std::string& item, double bits) {
    const Result<Coded> mosaic = byMosaic(heights, options), whole = byEncoder(heights, encoding);
    if (!mosaic.ok() || !whole.ok()) {
      std::printf(" %8s", "-");
      return;
    }
    char quantity[32] = "";
    std::snprintf(quantity, sizeof quantity, "rmse_ratio_at_%.1f_bits", bits);
    add(item, quantity, rmseOf(*mosaic, file) / rmseOf(*whole, file));
  }

  std::vector<ResultRow> rows_;
};

}  // namespace
}  // namespace tetrakis::bench

int main(int argc, char** argv) {
  using namespace tetrakis::bench;
  std::vector<std::string> folders, filters;
  std::string csv;
  Arguments arguments("Mosaics, beside an encoder that holds the plane: ratios");
  arguments.folders(folders, filters);
  arguments.csv(csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  Run run;
  std::printf("%-28s %8s %8s %8s %8s %8s %8s %8s\n", "mosaic / encoder", "lossless", "time",
              "within 1", "time", "at 0.1", "at 0.5", "at 2.0");
  const bool all = measureHeightFiles(
      folders, filters,
      [&](const std::string& path, const std::string& item) { return run.measure(path, item); });
  if (!all) return 1;
  return exitCode(updateResults(csv, "mosaic", run.rows()));
}
