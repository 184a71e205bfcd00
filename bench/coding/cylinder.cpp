// SPDX-License-Identifier: Apache-2.0
// bench_cylinder FILE...: global grids of heights, whose last column lies beside the first one, as
// planes and as cylinders: bytes at the RMSE that the plane has at some sizes, bytes to the last
// bit, and what is left of the seam. Errors are those of samples, unweighted.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "base/samples.hpp"
#include "bench/harness/arguments.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {
namespace {

constexpr uint64_t kSizes[] = {8000, 26000, 47000, 120000};

std::vector<double> samplesOf(const tools::HeightFile& file, std::span<const std::byte> data) {
  std::vector<double> values;
  withSampleType(file.sample, [&](auto type) {
    using T = decltype(type);
    for (size_t at = 0; at < data.size(); at += sizeof(T)) {
      T sample;
      std::memcpy(&sample, data.data() + at, sizeof sample);
      values.push_back(static_cast<double>(sample));
    }
  });
  return values;
}

/// A grid, and how far decoded samples are from it.
class Grid {
 public:
  explicit Grid(const tools::HeightFile& file)
      : file_(file), original_(samplesOf(file, file.data)) {}

  Result<Buffer> coded(bool goes_round, uint64_t bytes) const {
    tks_heights heights = makeHeights();
    heights.width = file_.width;
    heights.height = file_.height;
    heights.sample = file_.sample;
    heights.data = file_.data.data();
    heights.columns_go_round = goes_round;
    tks_encode_options options = makeEncodeOptions();
    options.bytes = bytes;
    options.lossless = bytes == 0;
    return encode(&heights, nullptr, options);
  }
  /// Without samples if something failed.
  std::vector<double> decoded(bool goes_round, uint64_t bytes) const {
    const Result<Buffer> stream = coded(goes_round, bytes);
    if (!stream.ok()) return {};
    Result<Decoder> decoder = Decoder::open(stream->bytes());
    if (!decoder.ok()) return {};
    const Result<std::vector<std::byte>> samples = decoder->heights();
    return samples.ok() ? samplesOf(file_, *samples) : std::vector<double>();
  }

  const std::vector<double>& original() const { return original_; }
  double rmse(const std::vector<double>& values) const {
    double sum = 0;
    for (size_t i = 0; i < values.size(); ++i) {
      const double error = values[i] - original_[i];
      sum += error * error;
    }
    return std::sqrt(sum / static_cast<double>(values.size()));
  }
  /// The mean step from a column to the next one, which may be the first one again.
  double jump(const std::vector<double>& values, size_t column) const {
    double sum = 0;
    for (size_t row = 0; row < values.size(); row += file_.width)
      sum += std::abs(values[row + column] - values[row + (column + 1) % file_.width]);
    return sum / file_.height;
  }
  /// The same of the errors of the values.
  double jumpOfErrors(const std::vector<double>& values, size_t column) const {
    std::vector<double> errors = values;
    for (size_t i = 0; i < errors.size(); ++i) errors[i] -= original_[i];
    return jump(errors, column);
  }
  size_t seam() const { return file_.width - 1; }

 private:
  const tools::HeightFile& file_;
  std::vector<double> original_;
};

/// The least bytes of a cylinder with that RMSE, to a thousandth.
uint64_t bytesAt(const Grid& grid, double rmse, uint64_t about) {
  uint64_t low = about * 9 / 10, high = about * 11 / 10;
  while (high - low > about / 1000) {
    const uint64_t middle = (low + high) / 2;
    (grid.rmse(grid.decoded(true, middle)) <= rmse ? high : low) = middle;
  }
  return high;
}

/// One line: RMSE, and the seam beside the same of the column in the middle.
void report(const Grid& grid, const char* what, uint64_t bytes, const std::vector<double>& values) {
  const size_t seam = grid.seam();
  std::printf("%-9s %8llu  rmse %8.3f  jump %8.2f of %8.2f  jump of errors %8.2f, inside %8.2f\n",
              what, static_cast<unsigned long long>(bytes), grid.rmse(values),
              grid.jump(values, seam), grid.jump(grid.original(), seam),
              grid.jumpOfErrors(values, seam), grid.jumpOfErrors(values, seam / 2));
  std::fflush(stdout);
}

Status measure(const std::string& path) {
  const Result<tools::HeightFile> file = tools::readHeights(path);
  if (!file.ok()) return file.status();
  const Grid grid(*file);
  std::array<uint64_t, 2> lossless{};
  for (const bool goes_round : {false, true}) {
    const Result<Buffer> stream = grid.coded(goes_round, 0);
    if (!stream.ok()) return stream.status();
    lossless[goes_round] = stream->bytes().size();
  }
  std::printf("%s\nlossless: plane %llu, cylinder %llu\n", path.c_str(),
              static_cast<unsigned long long>(lossless[0]),
              static_cast<unsigned long long>(lossless[1]));
  for (const uint64_t bytes : kSizes) {
    const std::vector<double> plane = grid.decoded(false, bytes);
    report(grid, "plane", bytes, plane);
    report(grid, "cylinder", bytes, grid.decoded(true, bytes));
    const uint64_t equal = bytesAt(grid, grid.rmse(plane), bytes);
    std::printf("equal rmse: %llu bytes, %+.2f %%\n", static_cast<unsigned long long>(equal),
                100 * (static_cast<double>(equal) / static_cast<double>(bytes) - 1));
  }
  return {};
}

}  // namespace
}  // namespace tetrakis::bench

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const tetrakis::Status status = tetrakis::bench::measure(argv[i]);
    if (!status.ok()) return tetrakis::bench::exitCode(status);
  }
}
