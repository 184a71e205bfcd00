// SPDX-License-Identifier: Apache-2.0
// bench_forests FILE...: the middle of each height field, of (2^(d + 1) + 1)^2 samples, as one
// plane and as a forest of 2 x 2 patches of (2^d + 1)^2 samples that have the same surface: bytes
// to the last bit and within an error, RMSE of equal bytes. The ratio says what the borders between
// patches cost. Of the forest each place of the surface counts once.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/peers/raster.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {
namespace {

struct Options {
  std::vector<std::string> files;
  std::vector<double> kilobytes = {16, 64};
  double max_error = 5;
  uint32_t most_depth = 10;
};

/// For each side the one that it is glued to: patches 0 and 1 above 2 and 3.
constexpr std::array<uint32_t, 16> kGlued = {
    TKS_BORDER, 7,  8,          TKS_BORDER, TKS_BORDER, TKS_BORDER, 12,         1,
    2,          15, TKS_BORDER, TKS_BORDER, 6,          TKS_BORDER, TKS_BORDER, 9};
constexpr uint32_t kPatches = kGlued.size() / 4;

/// A square of samples, and where they lie in the raster of the forest.
class Square {
 public:
  Square(const tools::HeightFile& file, uint32_t depth)
      : sample_(file.sample), depth_(depth), size_(tks_sample_bytes(file.sample)) {
    const uint32_t x0 = (file.width - side()) / 2, y0 = (file.height - side()) / 2;
    for (uint32_t y = 0; y < side(); ++y) {
      const auto row =
          file.data.begin() + static_cast<ptrdiff_t>((size_t{y0 + y} * file.width + x0) * size_);
      plane_.insert(plane_.end(), row, row + static_cast<ptrdiff_t>(side() * size_));
    }
    patches_.resize(size_t{kPatches} * width() * width() * size_);
    forEachPlace([&](size_t of_plane, size_t of_forest) {
      std::memcpy(patches_.data() + of_forest * size_, plane_.data() + of_plane * size_, size_);
    });
  }

  uint32_t side() const { return (2u << depth_) + 1; }
  tks_heights plane() const { return heights(side(), side(), plane_); }
  tks_heights forest() const {
    tks_heights forest = heights(width(), kPatches * width(), patches_);
    forest.domain = TKS_DOMAIN_FOREST;
    forest.forest = {depth_, kPatches, kGlued.data()};
    return forest;
  }

  /// Of decoded samples, of a plane or of the forest.
  double rmse(const std::vector<std::byte>& decoded, bool of_forest) const {
    const std::vector<double> original = samplesOf(plane_, sample_);
    const std::vector<double> samples = samplesOf(decoded, sample_);
    std::vector<double> errors(original.size());
    forEachPlace([&](size_t at, size_t patch) {
      errors[at] = samples[of_forest ? patch : at] - original[at];
    });
    double sum = 0;
    for (const double error : errors) sum += error * error;
    return std::sqrt(sum / static_cast<double>(errors.size()));
  }

 private:
  uint32_t width() const { return (1u << depth_) + 1; }

  /// visit(sample of the plane, sample of the forest)
  template <class Visit>
  void forEachPlace(const Visit& visit) const {
    const size_t w = width(), n = w - 1;
    for (size_t patch = 0; patch < kPatches; ++patch)
      for (size_t y = 0; y < w; ++y)
        for (size_t x = 0; x < w; ++x)
          visit((patch / 2 * n + y) * side() + patch % 2 * n + x, (patch * w + y) * w + x);
  }
  tks_heights heights(uint32_t columns, uint32_t rows, const std::vector<std::byte>& data) const {
    tks_heights given = makeHeights();
    given.width = columns;
    given.height = rows;
    given.sample = sample_;
    given.data = data.data();
    return given;
  }

  tks_sample sample_;
  uint32_t depth_;
  size_t size_;
  std::vector<std::byte> plane_, patches_;
};

struct Coded {
  uint64_t bytes = 0;
  double rmse = 0;
};

Result<Coded> coded(const Square& square, bool of_forest, const tks_encode_options& options) {
  const tks_heights heights = of_forest ? square.forest() : square.plane();
  const Result<Buffer> stream = encode(&heights, nullptr, options);
  if (!stream.ok()) return stream.status();
  Result<Decoder> decoder = Decoder::open(stream->bytes());
  if (!decoder.ok()) return decoder.status();
  const Result<std::vector<std::byte>> decoded = decoder->heights();
  if (!decoded.ok()) return decoded.status();
  return Coded{stream->bytes().size(), square.rmse(*decoded, of_forest)};
}

Status compare(const Square& square, const std::string& name, const tks_encode_options& options) {
  const Result<Coded> plane = coded(square, false, options), forest = coded(square, true, options);
  if (!plane.ok()) return plane.status();
  if (!forest.ok()) return forest.status();
  const bool by_bytes = options.bytes > 0;
  const double a = by_bytes ? plane->rmse : static_cast<double>(plane->bytes);
  const double b = by_bytes ? forest->rmse : static_cast<double>(forest->bytes);
  std::printf("  %-16s plane %10.2f %-5s forest %10.2f  %+.2f %%\n", name.c_str(), a,
              by_bytes ? "RMSE" : "bytes", b, 100 * (b / a - 1));
  std::fflush(stdout);
  return {};
}

Status measure(const Options& options, const std::string& path) {
  const Result<tools::HeightFile> file = tools::readHeights(path);
  if (!file.ok()) return file.status();
  uint32_t depth = options.most_depth;
  while (depth > 1 && (2u << depth) + 1 > std::min(file->width, file->height)) --depth;
  const Square square(*file, depth);
  std::printf("%s: %u x %u samples\n", path.c_str(), square.side(), square.side());
  tks_encode_options target = makeEncodeOptions();
  target.lossless = 1;
  if (Status status = compare(square, "lossless", target); !status.ok()) return status;
  target.lossless = 0;
  target.max_error = options.max_error;
  if (Status status = compare(square, "within an error", target); !status.ok()) return status;
  target.max_error = 0;
  for (const double kilobytes : options.kilobytes) {
    target.bytes = static_cast<uint64_t>(1024 * kilobytes);
    const std::string name = std::to_string(target.bytes) + " bytes";
    if (Status status = compare(square, name, target); !status.ok()) return status;
  }
  return {};
}

}  // namespace
}  // namespace tetrakis::bench

int main(int argc, char** argv) {
  using namespace tetrakis::bench;
  Options options;
  Arguments arguments("Height fields as one plane and as a forest of 2 x 2 patches.");
  arguments.required({"FILE", "height fields without voids"}, options.files);
  arguments.positive({"--error", "largest error of one stream"}, options.max_error);
  arguments.numbers({"--kilobytes", "sizes of streams with losses"}, options.kilobytes);
  if (const auto code = arguments.parse(argc, argv)) return *code;
  for (const std::string& file : options.files) {
    const tetrakis::Status status = measure(options, file);
    if (!status.ok()) return exitCode(status);
  }
}
