// SPDX-License-Identifier: Apache-2.0
// bench_regions [HEIGHT [IMAGE]]: what spatial regions cost in bytes, what windows of a stream cost
// to decode, and what a second thread gains.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>

#include "apps/tools/files/files.hpp"
#include "apps/tools/synth/synth.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/averages.hpp"
#include "bench/harness/bjontegaard.hpp"
#include "bench/harness/results.hpp"
#include "bench/peers/raster.hpp"
#include "tetrakis/tetrakis.hpp"

namespace {

using namespace tetrakis;
using bench::median;
using bench::Raster;
using bench::ResultRow;

constexpr uint32_t kSampleSide = 1025;
constexpr double kHighestRate = 4;  ///< bits a sample of the stream that curves are cut from

struct Options {
  std::string heights, image, csv;
  uint32_t side = 4097;
  int runs = 5;
};

/// One component, coded alone.
struct Subject {
  std::string name;
  Raster raster;

  bool isImage() const { return name == "texture"; }
};

Result<std::vector<uint8_t>> encode(const Subject& subject, double rate, uint32_t regions,
                                    uint32_t threads) {
  const Raster& raster = subject.raster;
  tks_encode_options options = makeEncodeOptions();
  options.bytes = static_cast<uint64_t>(rate * static_cast<double>(raster.pixels()) / 8);
  options.regions = regions;
  options.threads = threads;
  tks_heights heights = makeHeights();
  heights.sample = TKS_U16;
  tks_image image = makeImage();
  image.sample = TKS_U8;
  image.channels = raster.channels;
  heights.width = image.width = raster.width;
  heights.height = image.height = raster.height;
  heights.data = raster.samples.data();
  const std::vector<uint8_t> texels(raster.samples.begin(), raster.samples.end());
  image.data = texels.data();
  const auto stream = subject.isImage() ? tetrakis::encode(nullptr, &image, options)
                                        : tetrakis::encode(&heights, nullptr, options);
  if (!stream) return stream.status();
  return std::vector<uint8_t>(stream->bytes().begin(), stream->bytes().end());
}

/// Decodes a window (nullptr: everything) of the first bytes of a stream.
Result<std::vector<std::byte>> decode(const Subject& subject, std::span<const uint8_t> bytes,
                                      const tks_window* window, uint32_t threads) {
  auto decoder = Decoder::open(bytes);
  if (!decoder) return decoder.status();
  decoder->setThreads(threads);
  auto samples = subject.isImage() ? window ? decoder->texture(*window) : decoder->texture()
                 : window ? decoder->heights(*window)
                                   : decoder->heights();
  if (!samples) return samples.status();
  return std::move(*samples);
}

double psnrOf(const Subject& subject, const std::vector<std::byte>& decoded) {
  std::vector<uint16_t> samples(subject.raster.samples.size());
  if (subject.isImage()) {
    std::transform(decoded.begin(), decoded.end(), samples.begin(),
                   [](std::byte b) { return std::to_integer<uint16_t>(b); });
  } else {
    std::memcpy(samples.data(), decoded.data(), decoded.size());
  }
  const double peak = std::exp2(subject.raster.bits) - 1;
  return 10 * std::log10(peak * peak / meanSquaredError(subject.raster, samples));
}

/// Prefixes of one stream at rates sqrt 2 apart.
Result<std::vector<bench::RatePoint>> curveOf(const Subject& subject, uint32_t regions) {
  const auto stream = encode(subject, kHighestRate, regions, 2);
  if (!stream.ok()) return stream.status();
  std::vector<bench::RatePoint> curve;
  for (double rate = 0.05; rate < kHighestRate; rate *= std::sqrt(2)) {
    const auto bytes = static_cast<size_t>(rate * static_cast<double>(subject.raster.pixels()) / 8);
    if (bytes > stream->size()) break;
    const auto decoded = decode(subject, std::span(*stream).first(bytes), nullptr, 2);
    if (!decoded.ok()) return decoded.status();
    curve.push_back({rate, psnrOf(subject, *decoded)});
  }
  return curve;
}

struct Seconds {
  double processor, wall;
};

Result<Seconds> timed(const std::function<Status()>& work) {
  const std::clock_t start = std::clock();
  const auto wall = std::chrono::steady_clock::now();
  if (const Status status = work(); !status.ok()) return status;
  return Seconds{static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC,
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count()};
}

/// Medians of runs that alternate between all kinds of work.
Result<std::vector<Seconds>> timeAll(const std::vector<std::function<Status()>>& works, int runs) {
  std::vector<std::vector<double>> processor(works.size()), wall(works.size());
  for (int run = 0; run < runs; ++run) {
    for (size_t i = 0; i < works.size(); ++i) {
      const auto seconds = timed(works[i]);
      if (!seconds.ok()) return seconds.status();
      processor[i].push_back(seconds->processor);
      wall[i].push_back(seconds->wall);
    }
  }
  std::vector<Seconds> medians;
  for (size_t i = 0; i < works.size(); ++i)
    medians.push_back({median(processor[i]), median(wall[i])});
  return medians;
}

class Measurement {
 public:
  Measurement(const Subject& subject, int runs) : subject_(subject), runs_(runs) {}

  Status run(std::vector<ResultRow>& rows) {
    if (Status status = cost(); !status.ok()) return status;
    if (Status status = windows(); !status.ok()) return status;
    if (Status status = threads(); !status.ok()) return status;
    rows.insert(rows.end(), rows_.begin(), rows_.end());
    return {};
  }

 private:
  void state(const std::string& quantity, double value) {
    std::printf("%-10s %-32s %10.3f\n", subject_.name.c_str(), quantity.c_str(), value);
    std::fflush(stdout);
    rows_.push_back({subject_.name, "tetrakis", quantity, value});
  }

  Status cost() {
    const auto one = curveOf(subject_, 1), many = curveOf(subject_, 0);
    if (!one.ok()) return one.status();
    if (!many.ok()) return many.status();
    const auto difference = bench::rateDifference(*one, *many, {0.1, 2.5});
    if (!difference.ok()) return difference.status();
    state("regions_bd_rate_percent", 100 * difference->ratio);
    return {};
  }

  Status windows() {
    const auto one = encode(subject_, 1, 1, 2), many = encode(subject_, 1, 0, 2);
    if (!one.ok()) return one.status();
    if (!many.ok()) return many.status();
    const Raster& raster = subject_.raster;
    std::vector<tks_window> windows;
    for (const uint32_t part : {2u, 4u, 8u, 16u}) {
      const uint32_t width = raster.width / part, height = raster.height / part;
      windows.push_back({(raster.width - width) / 2, (raster.height - height) / 2, width, height});
    }
    std::vector<std::function<Status()>> works = {
        [&] { return decode(subject_, *one, nullptr, 1).status(); },
        [&] { return decode(subject_, *many, nullptr, 1).status(); }};
    for (const tks_window& window : windows)
      works.push_back([&] { return decode(subject_, *many, &window, 1).status(); });
    const auto seconds = timeAll(works, runs_);
    if (!seconds.ok()) return seconds.status();
    const double whole = (*seconds)[0].processor;
    state("whole_one_region_seconds", whole);
    const char* names[] = {"whole", "window_4th", "window_16th", "window_64th", "window_256th"};
    for (size_t i = 0; i < std::size(names); ++i)
      state(std::string(names[i]) + "_time_ratio", (*seconds)[i + 1].processor / whole);
    return {};
  }

  /// Wall clock: needs a machine with two idle cores.
  Status threads() {
    const auto stream = encode(subject_, 1, 0, 2);
    if (!stream.ok()) return stream.status();
    std::vector<std::function<Status()>> works;
    for (const uint32_t threads : {1u, 2u}) {
      works.push_back([=, this] { return encode(subject_, 1, 0, threads).status(); });
      works.push_back(
          [&, threads] { return decode(subject_, *stream, nullptr, threads).status(); });
    }
    const auto seconds = timeAll(works, runs_);
    if (!seconds.ok()) return seconds.status();
    state("encode_two_threads_speedup", (*seconds)[0].wall / (*seconds)[2].wall);
    state("decode_two_threads_speedup", (*seconds)[1].wall / (*seconds)[3].wall);
    return {};
  }

  const Subject& subject_;
  int runs_;
  std::vector<ResultRow> rows_;
};

Result<std::vector<Subject>> loadSubjects(const Options& options) {
  std::vector<Subject> subjects;
  const auto add = [&](const char* name, const Raster& raster) {
    subjects.push_back({name, mirrorTo(raster, options.side, options.side)});
  };
  if (options.heights.empty()) {
    tools::SynthOptions synth;
    synth.size = kSampleSide;
    const tools::SynthTerrain terrain = tools::synthesize(synth);
    const auto heights = bench::heightRaster(terrain.heights);
    if (!heights.ok()) return heights.status();
    add("heights", *heights);
    add("texture", bench::imageRaster(terrain.texture));
    return subjects;
  }
  const auto file = tools::readHeights(options.heights);
  if (!file.ok()) return file.status();
  const auto heights = bench::heightRaster(*file);
  if (!heights.ok()) return heights.status();
  add("heights", *heights);
  if (options.image.empty()) return subjects;
  const auto image = tools::readImage(options.image);
  if (!image.ok()) return image.status();
  add("texture", bench::imageRaster(*image));
  return subjects;
}

Status run(const Options& options) {
  const auto subjects = loadSubjects(options);
  if (!subjects.ok()) return subjects.status();
  std::vector<ResultRow> rows;
  for (const Subject& subject : *subjects) {
    if (Status status = Measurement(subject, options.runs).run(rows); !status.ok()) return status;
  }
  return bench::updateResults(options.csv, "regions", rows);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  tetrakis::bench::Arguments arguments(
      "Bytes of spatial regions, time of windows, gain of threads");
  arguments.text({"HEIGHT", "Height file; else the sample terrain"}, options.heights);
  arguments.text({"IMAGE", "Image"}, options.image);
  arguments.within({"--side", "Samples a side; files are cut or mirrored to it"}, options.side, 64,
                   16385);
  arguments.runs(options.runs);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return tetrakis::bench::exitCode(run(options));
}
