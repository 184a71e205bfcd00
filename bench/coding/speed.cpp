// SPDX-License-Identifier: Apache-2.0
// bench_speed [HEIGHT IMAGE]: encoding and decoding, one thread, beside OpenJPEG in one process:
// alternating runs, medians of the processor time, and their ratio.
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <functional>

#include "apps/tools/files/files.hpp"
#include "apps/tools/synth/synth.hpp"
#include "bench/harness/arguments.hpp"
#include "bench/harness/averages.hpp"
#include "bench/harness/results.hpp"
#include "bench/peers/child_memory.hpp"
#include "bench/peers/openjpeg_peer.hpp"
#include "bench/peers/tetrakis_peer.hpp"
#include "tetrakis/tetrakis.hpp"

namespace {

using namespace tetrakis;
using namespace tetrakis::bench;

using Bytes = std::vector<uint8_t>;

constexpr uint32_t kHeightSide = 1025;
constexpr uint32_t kImageSide = 1024;
constexpr uint64_t kJointBytes = 65536;
constexpr uint32_t kGraticule = 64;  // texels between the lines of a graticule
constexpr uint32_t kClasses = 16;    // of heights in a map of them

struct Options {
  std::string heights, image;  // both empty: the sample terrain
  int runs = 9;
  std::string csv;
};

struct Terrain {
  Raster heights, image;
  Raster overlaid, drawn;  ///< the image with lines over it; a map of the heights
};

/// The same work for both codecs.
struct Task {
  std::string name;
  double elements = 0;  ///< heights and pixels
  std::function<Status()> tetrakis, openjpeg;
};

/// What either codec makes of one source; OpenJPEG: one codestream for heights, one for the image.
struct Streams {
  Bytes tetrakis;
  std::vector<Bytes> openjpeg;
};

/// The image with white lines over it: a photograph with an overlay.
Raster withGraticule(Raster image) {
  for (size_t i = 0; i < image.samples.size(); ++i) {
    const size_t pixel = i / image.channels;
    if (pixel % image.width % kGraticule == 0 || pixel / image.width % kGraticule == 0)
      image.samples[i] = 255;
  }
  return image;
}

/// Classes of heights, each in a colour of its own: a drawn map.
Raster hypsometricMap(const Raster& heights, Raster image) {
  const Raster ground = mirrorTo(heights, image.width, image.height);
  const auto [low, high] = std::minmax_element(ground.samples.begin(), ground.samples.end());
  const uint32_t range = uint32_t{*high} - *low + 1u;
  for (size_t i = 0; i < image.samples.size(); ++i) {
    const uint32_t level = kClasses * (uint32_t{ground.samples[i / image.channels]} - *low) / range;
    image.samples[i] = static_cast<uint16_t>((level * (37 + 50 * (i % image.channels))) % 256);
  }
  return image;
}

Result<Terrain> loadTerrain(const Options& options) {
  tools::HeightFile heights;
  tools::ImageFile image;
  if (options.heights.empty()) {
    tools::SynthOptions synth;
    synth.size = kHeightSide;
    tools::SynthTerrain terrain = tools::synthesize(synth);
    heights = std::move(terrain.heights);
    image = std::move(terrain.texture);
  } else {
    auto height_file = tools::readHeights(options.heights);
    if (!height_file.ok()) return height_file.status();
    auto image_file = tools::readImage(options.image);
    if (!image_file.ok()) return image_file.status();
    heights = std::move(*height_file);
    image = std::move(*image_file);
  }
  const Result<Raster> samples = heightRaster(heights);
  if (!samples.ok()) return samples.status();
  Terrain terrain;
  terrain.heights = mirrorTo(*samples, kHeightSide, kHeightSide);
  terrain.image = mirrorTo(imageRaster(image), kImageSide, kImageSide);
  terrain.overlaid = withGraticule(terrain.image);
  terrain.drawn = hypsometricMap(terrain.heights, terrain.image);
  return terrain;
}

/// Codes `source` with either codec; OpenJPEG is given the bytes that Tetrakis spent on each track.
Result<Streams> makeStreams(const StreamSource& source, uint64_t bytes) {
  Streams streams;
  auto stream = encodeTetrakis(source, bytes);
  if (!stream.ok()) return stream.status();
  streams.tetrakis = std::move(*stream);
  const auto decoded = decodeTetrakis(streams.tetrakis);
  if (!decoded.ok()) return decoded.status();
  const double payload = static_cast<double>(decoded->geometry_bytes + decoded->texture_bytes);
  const auto share = [&](uint64_t track) {
    return static_cast<uint64_t>(static_cast<double>(bytes) * static_cast<double>(track) / payload);
  };
  for (const auto& [raster, track] : {std::pair(source.heights, decoded->geometry_bytes),
                                      std::pair(source.image, decoded->texture_bytes)}) {
    if (!raster) continue;
    auto codestream = encodeOpenJpeg(*raster, {std::max<uint64_t>(share(track), 1), 6});
    if (!codestream.ok()) return codestream.status();
    streams.openjpeg.push_back(std::move(*codestream));
  }
  return streams;
}

/// An encoding and a decoding task of the source at about `bytes`.
Status addTasks(const std::string& name, StreamSource source, uint64_t bytes,
                std::vector<Task>& tasks) {
  auto made = makeStreams(source, bytes);
  if (!made.ok()) return made.status();
  const auto streams = std::make_shared<const Streams>(std::move(*made));
  Task encode, decode;
  encode.name = name + "_encode";
  decode.name = name + "_decode";
  for (const Raster* raster : {source.heights, source.image}) {
    if (raster) encode.elements += static_cast<double>(raster->pixels());
  }
  decode.elements = encode.elements;
  encode.tetrakis = [=] { return encodeTetrakis(source, bytes).status(); };
  decode.tetrakis = [=] { return decodeTetrakisSamples(streams->tetrakis); };
  encode.openjpeg = [=] {
    size_t next = 0;
    for (const Raster* raster : {source.heights, source.image}) {
      if (!raster) continue;
      const uint64_t size = streams->openjpeg[next++].size();
      const Status status = encodeOpenJpeg(*raster, {size, 6}).status();
      if (!status.ok()) return status;
    }
    return Status();
  };
  decode.openjpeg = [=] {
    for (const Bytes& codestream : streams->openjpeg) {
      const Status status = decodeOpenJpeg(codestream).status();
      if (!status.ok()) return status;
    }
    return Status();
  };
  tasks.push_back(std::move(encode));
  tasks.push_back(std::move(decode));
  return {};
}

Result<std::vector<Task>> makeTasks(const Terrain& terrain) {
  const Raster &heights = terrain.heights, &image = terrain.image;
  const uint64_t one_bit = image.pixels() / 8;
  std::vector<Task> tasks;
  Status status = addTasks("joint_64k", {&heights, &image}, kJointBytes, tasks);
  if (status.ok())
    status = addTasks("heights_1bpp", {&heights, nullptr}, heights.pixels() / 8, tasks);
  if (status.ok()) status = addTasks("texture_1bpp", {nullptr, &image}, one_bit, tasks);
  if (status.ok()) status = addTasks("overlay_1bpp", {nullptr, &terrain.overlaid}, one_bit, tasks);
  if (status.ok()) status = addTasks("drawn_1bpp", {nullptr, &terrain.drawn}, one_bit, tasks);
  if (!status.ok()) return status;
  return tasks;
}

/// Processor seconds of this process: other work on the machine counts less than on a wall clock.
Result<double> processorSeconds(const std::function<Status()>& work) {
  const std::clock_t start = std::clock();
  const Status status = work();
  if (!status.ok()) return status;
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

struct Timing {
  double tetrakis = 0, openjpeg = 0;  ///< median seconds
};

Result<Timing> timeTask(const Task& task, int runs) {
  std::vector<double> ours, theirs;
  for (int i = 0; i < runs; ++i) {
    for (const auto& [work, seconds] :
         {std::pair(&task.tetrakis, &ours), std::pair(&task.openjpeg, &theirs)}) {
      const Result<double> time = processorSeconds(*work);
      if (!time.ok()) return time.status();
      seconds->push_back(*time);
    }
  }
  return Timing{median(ours), median(theirs)};
}

Result<std::vector<ResultRow>> measure(const std::vector<Task>& tasks, int runs) {
  constexpr double kMiB = 1 << 20;
  std::vector<std::pair<double, double>> peaks;
  for (const Task& task : tasks) {
    const auto ours = peakMemory(task.tetrakis);
    if (!ours.ok()) return ours.status();
    const auto theirs = peakMemory(task.openjpeg);
    if (!theirs.ok()) return theirs.status();
    peaks.emplace_back(static_cast<double>(*ours) / kMiB, static_cast<double>(*theirs) / kMiB);
  }
  std::vector<ResultRow> rows;
  std::printf("%-20s %23s %9s %17s\n%-20s %11s %11s %9s %8s %8s\n", "", "million elements / s",
              "speed", "peak MiB", "task", "tetrakis", "openjpeg97", "ratio", "tetrakis",
              "openjpeg");
  for (size_t i = 0; i < tasks.size(); ++i) {
    const Task& task = tasks[i];
    const auto timing = timeTask(task, runs);
    if (!timing.ok()) return timing.status();
    const double ours = task.elements / timing->tetrakis / 1e6;
    const double theirs = task.elements / timing->openjpeg / 1e6;
    std::printf("%-20s %11.2f %11.2f %9.3f %8.1f %8.1f\n", task.name.c_str(), ours, theirs,
                ours / theirs, peaks[i].first, peaks[i].second);
    std::fflush(stdout);
    rows.push_back({task.name, "tetrakis", "melements_per_second", ours});
    rows.push_back({task.name, "tetrakis", "speed_ratio", ours / theirs});
    rows.push_back({task.name, "tetrakis", "peak_mib", peaks[i].first});
    rows.push_back({task.name, "openjpeg97", "melements_per_second", theirs});
    rows.push_back({task.name, "openjpeg97", "peak_mib", peaks[i].second});
  }
  return rows;
}

/// Decodes everything; a failure is an exception to what the bench can go on with.
Status decodeAll(Decoder& decoder) {
  if (const auto heights = decoder.heights(); !heights.ok()) return heights.status();
  return decoder.texture().status();
}

/// A decoder for each of kPrefixes prefixes against one to which their bytes are appended.
Status measurePrefixes(const Terrain& terrain, int runs, std::vector<ResultRow>& rows) {
  constexpr size_t kPrefixes = 20;
  const auto stream = encodeTetrakis({&terrain.heights, &terrain.image}, 16 * kJointBytes);
  if (!stream.ok()) return stream.status();
  const auto opened = [&](size_t i) {
    constexpr size_t kFirst = 2048;
    return std::span(*stream).first(kFirst + (stream->size() - kFirst) * i / kPrefixes);
  };
  const auto apart = [&]() -> Status {
    for (size_t i = 0; i <= kPrefixes; ++i) {
      Result<Decoder> decoder = Decoder::open(opened(i));
      if (!decoder.ok()) return decoder.status();
      if (Status status = decodeAll(*decoder); !status.ok()) return status;
    }
    return {};
  };
  const auto appended = [&]() -> Status {
    Result<Decoder> decoder = Decoder::open(opened(0));
    if (!decoder.ok()) return decoder.status();
    for (size_t i = 0; i <= kPrefixes; ++i) {
      const auto more = opened(i).subspan(opened(i > 0 ? i - 1 : 0).size());
      if (Status status = decoder->append(more); !status.ok()) return status;
      if (Status status = decodeAll(*decoder); !status.ok()) return status;
    }
    return {};
  };
  std::vector<double> ratios;
  for (int i = 0; i < runs; ++i) {
    const Result<double> alone = processorSeconds(apart), grown = processorSeconds(appended);
    if (!alone.ok()) return alone.status();
    if (!grown.ok()) return grown.status();
    ratios.push_back(*alone / *grown);
  }
  const double ratio = median(ratios);
  std::printf("%zu prefixes of 1 MiB: appended %.2f times as fast as decoded one by one\n",
              kPrefixes + 1, ratio);
  rows.push_back({"joint_1m_prefixes", "tetrakis", "append_speedup", ratio});
  return {};
}

/// Heights and texture by themselves, in so many bytes each.
Status encodeApart(const Terrain& terrain, uint64_t height_bytes, uint64_t texture_bytes) {
  const Status heights = encodeTetrakis({&terrain.heights, nullptr}, height_bytes).status();
  if (!heights.ok()) return heights;
  return encodeTetrakis({nullptr, &terrain.image}, texture_bytes).status();
}

/// What it takes to share bytes between heights and texture: the time of encoding both, over that
/// of either in as many bytes as it has got (which only the joint encoding finds out), and over
/// that of either in all of the bytes (which the joint encoding has to reckon with).
Status measureSharing(const Terrain& terrain, int runs, std::vector<ResultRow>& rows) {
  const StreamSource both{&terrain.heights, &terrain.image};
  const auto stream = encodeTetrakis(both, kJointBytes);
  if (!stream.ok()) return stream.status();
  const auto decoded = decodeTetrakis(*stream);
  if (!decoded.ok()) return decoded.status();
  const std::array<std::function<Status()>, 3> works = {
      [&] { return encodeTetrakis(both, kJointBytes).status(); },
      [&] { return encodeApart(terrain, decoded->geometry_bytes, decoded->texture_bytes); },
      [&] { return encodeApart(terrain, kJointBytes, kJointBytes); }};
  std::array<std::vector<double>, 3> seconds;
  for (int i = 0; i < runs; ++i)
    for (size_t k = 0; k < works.size(); ++k) {
      const Result<double> time = processorSeconds(works[k]);
      if (!time.ok()) return time.status();
      seconds[k].push_back(*time);
    }
  const double joint = median(seconds[0]);
  const double shares = joint / median(seconds[1]), whole = joint / median(seconds[2]);
  std::printf(
      "both in 64 kB: %.2f times the time of either in its share by itself, %.2f times that of "
      "either in 64 kB\n",
      shares, whole);
  rows.push_back({"joint_64k_encode", "tetrakis", "time_over_shares_apart", shares});
  rows.push_back({"joint_64k_encode", "tetrakis", "time_over_64k_apart", whole});
  return {};
}

Status run(const Options& options) {
  if (options.heights.empty() != options.image.empty())
    return Status(TKS_USAGE, "a height file and an image go together");
  const Result<Terrain> terrain = loadTerrain(options);
  if (!terrain.ok()) return terrain.status();
  const auto tasks = makeTasks(*terrain);
  if (!tasks.ok()) return tasks.status();
  auto rows = measure(*tasks, options.runs);
  if (!rows.ok()) return rows.status();
  if (Status s = measureSharing(*terrain, options.runs, *rows); !s.ok()) return s;
  if (Status s = measurePrefixes(*terrain, options.runs, *rows); !s.ok()) return s;
  return updateResults(options.csv, "speed", *rows);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  Arguments arguments("Speed and memory of coding a terrain, beside OpenJPEG 9/7");
  arguments.text({"HEIGHT", "Height file"}, options.heights);
  arguments.text({"IMAGE", "Image of the same footprint; with a height file"}, options.image);
  arguments.runs(options.runs);
  arguments.csv(options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return exitCode(run(options));
}
