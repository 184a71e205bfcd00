// SPDX-License-Identifier: Apache-2.0
// bench_globe FILE...: global grids of heights, whose columns go round the Earth from pole to pole,
// as planes and as cylinders, with equal samples and with equal areas, and on cubes: bytes at equal
// RMSE over the area of the Earth, bytes to the last bit (of cubes: of their own samples), and what
// is left of the seam between the last column and the first one. Errors on cubes are those of the
// grid that is made of them, what is lost by resampling among them. Then meshes of few triangles of
// the streams to the last bit: their RMSE over the area.
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/files.hpp"
#include "apps/tools/files/place/ground_spacing.hpp"
#include "apps/tools/files/stream.hpp"
#include "bench/coding/globe_meshes.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/peers/raster.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {
namespace {

struct Options {
  std::vector<std::string> files;
  std::vector<double> errors = {110, 80, 55};
  std::vector<double> triangles = {2000, 20000, 100000};
  uint32_t depth = 0;
};

/// How a grid is coded.
struct Coding {
  const char* name;
  tools::HeightFile heights;
  bool by_area;  ///< the encoder is told the latitudes
};

Result<std::vector<Coding>> codingsOf(const tools::HeightFile& grid, uint32_t cube_depth) {
  tools::HeightFile ring = grid;
  ring.domain = TKS_DOMAIN_CYLINDER;
  tools::CubeErrors errors;
  Result<tools::HeightFile> cube = tools::onCube(grid, cube_depth, 1, errors);
  if (!cube.ok()) return cube.status();
  std::printf("cube of depth %u: resampled with an RMSE of %.2f, largest error %.0f\n",
              cube->cube_depth, errors.rmse, errors.largest);
  return std::vector<Coding>{{"plane", grid, false},
                             {"plane, weights", grid, true},
                             {"cylinder", ring, false},
                             {"cylinder, weights", ring, true},
                             {"cube", std::move(*cube), false}};
}

/// How decoded samples are off: over the area of the Earth, and from one side of the seam to the
/// other, as root mean squares.
struct Figures {
  double rmse = 0, seam = 0;
};

class Globe {
 public:
  explicit Globe(const tools::HeightFile& file)
      : file_(file),
        latitudes_(tools::edgeLatitudes(file, file.height)),
        original_(samplesOf(file.data, file.sample)) {}

  /// bytes: 0, to the last bit.
  Result<Buffer> coded(const Coding& coding, uint64_t bytes) const {
    tks_heights heights = tools::asHeights(coding.heights);
    if (coding.by_area) {
      heights.first_latitude = latitudes_[0];
      heights.last_latitude = latitudes_[1];
    }
    tks_encode_options options = makeEncodeOptions();
    options.bytes = bytes;
    options.lossless = bytes == 0;
    return encode(&heights, nullptr, options);
  }

  Result<Figures> figures(const Coding& coding, uint64_t bytes) const {
    const Result<Buffer> stream = coded(coding, bytes);
    if (!stream.ok()) return stream.status();
    Result<Decoder> decoder = Decoder::open(stream->bytes());
    if (!decoder.ok()) return decoder.status();
    const Result<tools::HeightFile> decoded = tools::decodeHeights(*decoder);
    if (!decoded.ok()) return decoded.status();
    const std::vector<double> values = samplesOf(decoded->data, file_.sample);
    return Figures{rmse(values), jump(values)};
  }

  /// Of the mesh of so many triangles.
  Result<double> meshError(std::span<const uint8_t> stream, uint32_t triangles) const {
    Result<Decoder> decoder = Decoder::open(stream);
    if (!decoder.ok()) return decoder.status();
    Result<std::vector<float>> surface = surfaceOfGlobe(*decoder, triangles);
    if (surface.ok() && tools::isGridOnCube(decoder->info()))
      surface = tools::gridOfCube(decoder->info(), *surface);
    if (!surface.ok()) return surface.status();
    return rmse({surface->begin(), surface->end()});
  }
  /// Between the two sides of the seam, as the ground has it.
  double jump() const { return jump(original_); }

 private:
  double rmse(const std::vector<double>& values) const {
    double sum = 0, area = 0;
    for (size_t y = 0; y < file_.height; ++y) {
      const double latitude = std::numbers::pi * (static_cast<double>(y) + 0.5) / file_.height;
      const double weight = std::sin(latitude);
      for (size_t i = y * file_.width; i < (y + 1) * file_.width; ++i) {
        sum += weight * (values[i] - original_[i]) * (values[i] - original_[i]);
        area += weight;
      }
    }
    return std::sqrt(sum / area);
  }
  double jump(const std::vector<double>& values) const {
    double sum = 0;
    for (size_t row = 0; row < values.size(); row += file_.width) {
      const double step = values[row] - values[row + file_.width - 1];
      sum += step * step;
    }
    return std::sqrt(sum / file_.height);
  }

  const tools::HeightFile& file_;
  std::array<double, 2> latitudes_;
  std::vector<double> original_;
};

/// The least bytes at which no more error is left, to a thousandth, and what these leave.
struct AtError {
  uint64_t bytes;
  Figures figures;
};

Result<AtError> atError(const Globe& globe, const Coding& coding, double error, uint64_t most) {
  AtError found{most, {0, globe.jump()}};
  for (uint64_t low = 0; found.bytes - low > 1 + found.bytes / 2000;) {
    const uint64_t middle = low + (found.bytes - low) / 2;
    const Result<Figures> figures = globe.figures(coding, middle);
    if (!figures.ok()) return figures.status();
    if (figures->rmse <= error)
      found = {middle, *figures};
    else
      low = middle;
  }
  return found;
}

Status measure(const Options& options, const std::string& path) {
  const Result<tools::HeightFile> file = tools::readHeights(path);
  if (!file.ok()) return file.status();
  const Globe globe(*file);
  std::printf("%s: %u x %u, step at the seam %.1f\n", path.c_str(), file->width, file->height,
              globe.jump());
  const Result<std::vector<Coding>> codings = codingsOf(*file, options.depth);
  if (!codings.ok()) return codings.status();
  for (const Coding& coding : *codings) {
    const Result<Buffer> lossless = globe.coded(coding, 0);
    if (!lossless.ok()) return lossless.status();
    const uint64_t whole = lossless->bytes().size();
    for (const double triangles : options.triangles) {
      const Result<double> error =
          globe.meshError(lossless->bytes(), static_cast<uint32_t>(triangles));
      if (!error.ok()) return error.status();
      std::printf("%-17s mesh of %.0f triangles: RMSE %.1f\n", coding.name, triangles, *error);
    }
    std::printf("%-17s to the last bit: %llu bytes\n", coding.name,
                static_cast<unsigned long long>(whole));
    for (const double error : options.errors) {
      const Result<AtError> at = atError(globe, coding, error, whole);
      if (!at.ok()) return at.status();
      std::printf("  RMSE %5.1f: %7llu bytes, step at the seam %.1f\n", error,
                  static_cast<unsigned long long>(at->bytes), at->figures.seam);
      std::fflush(stdout);
    }
  }
  return {};
}

}  // namespace
}  // namespace tetrakis::bench

int main(int argc, char** argv) {
  using namespace tetrakis::bench;
  Options options;
  Arguments arguments(
      "Global grids of heights as planes and as cylinders, by samples and by area, and on cubes.");
  arguments.required({"FILE", "global grids"}, options.files);
  arguments.numbers({"--errors", "RMSEs over the area of the Earth"}, options.errors);
  arguments.numbers({"--triangles", "of meshes"}, options.triangles);
  arguments.within({"--depth", "of the cube; 0: chosen"}, options.depth, 0, TKS_MOST_CUBE_DEPTH);
  if (const auto code = arguments.parse(argc, argv)) return *code;
  for (const std::string& file : options.files) {
    const tetrakis::Status status = measure(options, file);
    if (!status.ok()) return exitCode(status);
  }
}
