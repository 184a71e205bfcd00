// SPDX-License-Identifier: Apache-2.0
// bench_max_error DIR...: bytes at equal largest error, beside LERC (libLerc), which codes floats
// and integers within a bound, and beside LERC in ZSTD at its highest level, as GeoTIFFs mostly
// have it. Both get the samples of the file and its voids; both are decoded and checked. A bound of
// 0 is lossless.
#include <Lerc_c_api.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "apps/tools/files/files.hpp"
#include "apps/tools/report/scene.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/height_files.hpp"
#include "bench/harness/results.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {
namespace {

struct Options {
  std::vector<std::string> folders, filters;
  std::vector<double> errors = {0, 0.1, 0.5, 1, 2, 5, 10};
  std::optional<double> nodata;
  std::string csv;
};

/// Heights of a file, where they are void (NaN), and the largest distance of others from them.
class Judge {
 public:
  explicit Judge(const tools::HeightFile& file) : file_(file), truth_(tools::heightsOf(file)) {}

  bool isVoid(size_t i) const { return std::isnan(truth_.values[i]); }
  size_t count() const { return truth_.values.size(); }

  /// Infinity if a valid sample came back void.
  double largestError(const std::vector<std::byte>& samples) const {
    tools::HeightFile decoded = file_;
    decoded.data = samples;
    const tools::Surface surface = tools::heightsOf(decoded);
    double largest = 0;
    for (size_t i = 0; i < count(); ++i) {
      if (isVoid(i)) continue;
      const double error = std::abs(surface.values[i] - truth_.values[i]);
      largest = std::isnan(error) ? INFINITY : std::max(largest, error);
    }
    return largest;
  }

 private:
  const tools::HeightFile& file_;
  tools::Surface truth_;
};

struct Coded {
  size_t bytes = 0, in_zstd = 0;
  double largest_error = INFINITY;
};

Result<Coded> withTetrakis(const tools::HeightFile& file, const Judge& judge, double error) {
  tks_heights heights = makeHeights();
  heights.width = file.width;
  heights.height = file.height;
  heights.sample = file.sample;
  heights.data = file.data.data();
  heights.scale = file.scale;
  heights.offset = file.offset;
  heights.has_nodata = file.nodata.has_value();
  heights.nodata = file.nodata.value_or(0);
  tks_encode_options options = makeEncodeOptions();
  options.max_error = error;
  options.lossless = error == 0;
  const Result<Buffer> stream = encode(&heights, nullptr, options);
  if (!stream) return stream.status();
  Result<Decoder> decoder = Decoder::open(stream->bytes());
  if (!decoder) return decoder.status();
  const Result<std::vector<std::byte>> samples = decoder->heights();
  if (!samples) return samples.status();
  return Coded{stream->bytes().size(), 0, judge.largestError(*samples)};
}

/// How many bytes ZSTD makes of so many, at its highest level.
size_t bytesInZstd(const std::vector<unsigned char>& code, size_t size) {
  std::vector<unsigned char> packed(ZSTD_compressBound(size));
  const size_t bytes =
      ZSTD_compress(packed.data(), packed.size(), code.data(), size, ZSTD_maxCLevel());
  return ZSTD_isError(bytes) != 0 ? size : bytes;
}

/// LERC's names of sample types: char, uchar, short, ushort, int, uint, float.
unsigned lercType(tks_sample sample) {
  constexpr std::array<unsigned, 7> kTypes = {1, 0, 3, 2, 5, 4, 6};
  return kTypes[sample];
}

Result<Coded> withLerc(const tools::HeightFile& file, const Judge& judge, double error) {
  std::vector<unsigned char> valid(judge.count());
  for (size_t i = 0; i < valid.size(); ++i) valid[i] = !judge.isVoid(i);
  const bool voids = std::find(valid.begin(), valid.end(), 0) != valid.end();
  const auto width = static_cast<int>(file.width), height = static_cast<int>(file.height);
  const unsigned type = lercType(file.sample);
  const double bound = error / std::abs(file.scale);
  std::vector<unsigned char> code(file.data.size() * 2 + 4096);
  unsigned written = 0;
  const unsigned char* mask = voids ? valid.data() : nullptr;
  if (lerc_encode(file.data.data(), type, 1, width, height, 1, voids, mask, bound, code.data(),
                  static_cast<unsigned>(code.size()), &written) != 0) {
    return Status(TKS_MISMATCH, "LERC does not encode these heights");
  }
  std::vector<std::byte> samples(file.data.size());
  if (lerc_decode(code.data(), written, voids, valid.data(), 1, width, height, 1, type,
                  samples.data()) != 0) {
    return Status(TKS_MISMATCH, "LERC does not decode its own code");
  }
  return Coded{written, bytesInZstd(code, written), judge.largestError(samples)};
}

Status measureFile(const std::string& path, const std::string& item, const Options& options,
                   std::vector<ResultRow>& rows) {
  Result<tools::HeightFile> file = tools::readHeights(path);
  if (!file.ok()) return file.status();
  if (options.nodata) file->nodata = options.nodata;
  const Judge judge(*file);
  for (const double error : options.errors) {
    const bool integer = file->sample != TKS_F32;
    if (integer && error > 0 && error < std::abs(file->scale)) continue;  // as good as lossless
    const Result<Coded> ours = withTetrakis(*file, judge, error);
    if (!ours.ok()) return ours.status();
    const Result<Coded> lerc = withLerc(*file, judge, error);
    if (!lerc.ok()) return lerc.status();
    if (ours->largest_error > error) return Status(TKS_MISMATCH, item + ": the bound is broken");
    const auto over = [&](size_t bytes) {
      return static_cast<double>(ours->bytes) / static_cast<double>(bytes);
    };
    std::printf("%-24s %8g %10zu %10zu %7.3f %10zu %7.3f   %g %g\n", item.c_str(), error,
                ours->bytes, lerc->bytes, over(lerc->bytes), lerc->in_zstd, over(lerc->in_zstd),
                ours->largest_error, lerc->largest_error);
    std::fflush(stdout);
    char at[32];
    std::snprintf(at, sizeof at, "%g", error);
    rows.push_back(
        {item, "tetrakis", std::string("bytes_within_") + at, static_cast<double>(ours->bytes)});
    rows.push_back(
        {item, "lerc", std::string("bytes_within_") + at, static_cast<double>(lerc->bytes)});
    rows.push_back(
        {item, "lerc_zstd", std::string("bytes_within_") + at, static_cast<double>(lerc->in_zstd)});
  }
  return {};
}

int run(const Options& options) {
  std::vector<ResultRow> rows;
  std::printf("%-24s %8s %10s %10s %7s %10s %7s   %s\n", "file", "error", "tetrakis", "lerc",
              "ratio", "in ZSTD", "ratio", "errors found");
  const bool all = measureHeightFiles(options.folders, options.filters,
                                      [&](const std::string& path, const std::string& item) {
                                        return measureFile(path, item, options, rows);
                                      });
  if (!all) return 1;
  return exitCode(updateResults(options.csv, "max_error", rows));
}

}  // namespace
}  // namespace tetrakis::bench

int main(int argc, char** argv) {
  tetrakis::bench::Options options;
  tetrakis::bench::Arguments arguments("Bytes at equal largest error, beside LERC");
  arguments.folders(options.folders, options.filters);
  arguments.numbers({"--errors", "Bounds in the unit of the heights; 0: lossless"}, options.errors);
  arguments.number({"--nodata", "Samples of this value are void"}, options.nodata);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return tetrakis::bench::run(options);
}
