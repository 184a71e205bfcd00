// SPDX-License-Identifier: Apache-2.0
// bench_control FOLDER: the four cases of the thesis (1.2.5), a static or a dynamic source with a
// static or a dynamic view, for the three receivers of its figure 1.2 and one behind a radio, in a
// simulation of slots of a tenth of a second.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "bench/harness/arguments.hpp"
#include "bench/receivers/control_senders.hpp"

namespace tetrakis::bench {
namespace {

struct Options {
  std::string folder, csv;
  double fps = 5;
  uint64_t group = 4, reference = 1200, key = 40;
};

constexpr double kMost = 512e3;  ///< bits a second that groups and differences are encoded for

/// Figure 1.2: the second has a link of 512 kb/s as well, and is sent a quarter of that, since it
/// draws no more.
constexpr LinkEnd kReceivers[] = {{"R1, strong", 512e3, 512e3, 0, 0},
                                  {"R2, weak renderer", 512e3, 128e3, 400, 0},
                                  {"R3, slow link", 256e3, 256e3, 0, 0},
                                  {"robot, 2 % lost", 64e3, 64e3, 0, 0.02}};

struct Seen {
  std::vector<double> psnr;  ///< of each frame
  double rate = 0, control = 0, latency = 0;
};

/// Sends all frames, and looks at each when it is due.
Result<Seen> simulate(const Source& source, Sender& sender, const LinkEnd& end, bool moves) {
  Seen seen;
  std::mt19937 random(1);
  const auto viewAt = [&](double time) {
    return moves ? std::optional(flightAt(source, std::clamp(time, 0., source.seconds())))
                 : std::nullopt;
  };
  const double latency = sender.latency();
  for (int slot = 0; seen.psnr.size() < source.frames.size(); ++slot) {
    const double time = slot * kSlot;
    const bool is_lost = static_cast<double>(random() % 10000) < end.lost * 10000;
    if (Status status = sender.pass(time, viewAt(time - kSlot), is_lost); !status.ok())
      return status;
    for (;;) {
      const size_t frame = seen.psnr.size();
      const double due = static_cast<double>(frame) / source.fps + latency;
      if (frame == source.frames.size() || due > time + kSlot + 1e-9) break;
      const Result<Heights> shown = sender.shown(frame);
      if (!shown.ok()) return shown.status();
      seen.psnr.push_back(psnrOf(source, frame, *shown, viewAt(due)));
    }
  }
  const double seconds = source.seconds() + latency;
  seen.rate = static_cast<double>(sender.bytes) * 8 / seconds;
  seen.control = static_cast<double>(sender.control) / seconds;
  seen.latency = latency;
  return seen;
}

double meanOf(std::vector<double>::const_iterator begin, std::vector<double>::const_iterator end) {
  double sum = 0;
  for (auto at = begin; at != end; ++at) sum += *at;
  return sum / static_cast<double>(end - begin);
}

void report(const char* kind, const LinkEnd& end, const char* way, const Seen& seen) {
  std::vector<double> sorted = seen.psnr;
  std::sort(sorted.begin(), sorted.end());
  const auto quarter = static_cast<ptrdiff_t>(seen.psnr.size() / 4);
  std::printf("%-5s %-18s %-16s %6.0f %7.2f %7.2f %7.2f %8.2f %8.0f\n", kind, end.name, way,
              seen.rate / 1000, meanOf(sorted.begin(), sorted.end()), sorted[sorted.size() / 20],
              meanOf(seen.psnr.end() - quarter, seen.psnr.end()), seen.latency, seen.control);
  std::fflush(stdout);
}

/// What is encoded once for all, or once for each rate.
struct Encoded {
  EncodedGroups groups;
  uint32_t group = 1;  ///< frames of one
  EncodedFrames differences;
  std::vector<EncodedFrames> frames;  ///< by receivers
};

/// Of a source that stands still one frame is all there is.
Result<EncodedGroups> encodeStill(const Source& source) {
  Source one = source;
  one.frames.resize(1);
  return encodeGroups(one, 1, static_cast<uint64_t>(kMost / 8 * source.seconds()), 0);
}

Result<Encoded> encodeAll(const Source& source, bool is_still, const Options& options) {
  const auto frameBytes = [&](double rate) { return static_cast<uint64_t>(rate / 8 / source.fps); };
  const auto group = static_cast<uint32_t>(is_still ? 1 : options.group);
  auto groups = is_still ? encodeStill(source)
                         : encodeGroups(source, group, frameBytes(kMost), options.reference);
  if (!groups.ok()) return groups.status();
  auto differences = encodeDifferences(source, frameBytes(kMost), options.key);
  if (!differences.ok()) return differences.status();
  Encoded encoded{*std::move(groups), group, *std::move(differences), {}};
  for (const LinkEnd& end : kReceivers) {
    auto frames = encodeFrames(source, frameBytes(end.sent));
    if (!frames.ok()) return frames.status();
    encoded.frames.push_back(*std::move(frames));
  }
  const auto each = [&](double seconds) {
    return seconds / static_cast<double>(source.frames.size());
  };
  std::printf("encode s/frame: groups %.3f, differences %.3f, frames %.3f each of %zu rates\n",
              each(encoded.groups.seconds), each(encoded.differences.seconds),
              each(encoded.frames.front().seconds), encoded.frames.size());
  return encoded;
}

/// PSNR over time, a column each.
class Curves {
 public:
  void add(const std::string& name, const Seen& seen) {
    names_.push_back(name);
    columns_.push_back(seen.psnr);
  }
  Status write(const std::string& path, double fps) const {
    if (path.empty()) return {};
    std::FILE* const file = std::fopen(path.c_str(), "w");
    if (file == nullptr) return {TKS_IO, "cannot write " + path};
    std::fprintf(file, "seconds");
    for (const std::string& name : names_) std::fprintf(file, ",\"%s\"", name.c_str());
    for (size_t i = 0; i < columns_.front().size(); ++i) {
      std::fprintf(file, "\n%g", static_cast<double>(i) / fps);
      for (const auto& column : columns_) std::fprintf(file, ",%.3f", column[i]);
    }
    std::fprintf(file, "\n");
    return std::fclose(file) == 0 ? Status() : Status(TKS_IO, "cannot write " + path);
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<double>> columns_;
};

using Ways = std::vector<std::pair<const char*, Result<std::unique_ptr<Sender>>>>;

Ways waysTo(size_t receiver, const Source& source, const Encoded& encoded) {
  const LinkEnd& end = kReceivers[receiver];
  Ways ways;
  ways.emplace_back("system control", controlledSender(source, encoded.groups, encoded.group, end));
  ways.emplace_back("separate frames", frameSender(source, encoded.frames[receiver], end));
  ways.emplace_back("differences", frameSender(source, encoded.differences, end));
  ways.emplace_back("newest tile", tileSender(source, end));
  return ways;
}

Status runCases(const Source& source, bool is_still, const Options& options, Curves& curves) {
  const char* const names[] = {is_still ? "SVSS" : "SVDS", is_still ? "DVSS" : "DVDS"};
  const Result<Encoded> encoded = encodeAll(source, is_still, options);
  if (!encoded.ok()) return encoded.status();
  for (const bool moves : {false, true}) {
    for (size_t receiver = 0; receiver < std::size(kReceivers); ++receiver) {
      for (auto& [way, sender] : waysTo(receiver, source, *encoded)) {
        if (!sender.ok()) return sender.status();
        const Result<Seen> seen = simulate(source, **sender, kReceivers[receiver], moves);
        if (!seen.ok()) return seen.status();
        report(names[moves], kReceivers[receiver], way, *seen);
        curves.add(std::string(names[moves]) + " " + kReceivers[receiver].name + " " + way, *seen);
      }
    }
  }
  return {};
}

/// PSNR of the best mesh that a renderer draws of the first frame itself.
Result<double> psnrOfMesh(const Source& source, uint32_t triangles) {
  const tks_heights heights = givenHeights(source.width, source.height, source.frames.front());
  tks_encode_options options = makeEncodeOptions();
  options.lossless = 1;
  const Result<Buffer> stream = encode(&heights, nullptr, options);
  if (!stream) return stream.status();
  Result<Decoder> decoder = Decoder::open(stream->bytes());
  if (!decoder) return decoder.status();
  const Result<Mesh> mesh = decoder->budgetMesh(triangles);
  if (!mesh) return mesh.status();
  const tools::Surface shown = tools::rasterize(*mesh, source.width, source.height);
  return psnrOf(source, 0, {shown.values.begin(), shown.values.end()}, std::nullopt);
}

Status run(const Options& options) {
  const Result<Source> source = readSource(options.folder, options.fps);
  if (!source.ok()) return source.status();
  for (const LinkEnd& end : kReceivers) {
    if (end.triangles == 0) continue;
    const Result<double> most = psnrOfMesh(*source, end.triangles);
    if (!most.ok()) return most.status();
    std::printf("%s draws %u triangles, which show %.2f dB\n", end.name, end.triangles, *most);
  }
  std::printf("%-5s %-18s %-16s %6s %7s %7s %7s %8s %8s\n", "case", "receiver", "way", "kb/s",
              "mean dB", "5 %", "end", "latency", "control");
  Curves curves;
  if (Status status = runCases(source->still(), true, options, curves); !status.ok()) return status;
  if (Status status = runCases(*source, false, options, curves); !status.ok()) return status;
  return curves.write(options.csv, options.fps);
}

}  // namespace
}  // namespace tetrakis::bench

int main(int argc, char** argv) {
  using namespace tetrakis::bench;
  Options options;
  Arguments arguments("Four cases of sources and views, for receivers of several links");
  arguments.text({"FOLDER", "Holds frames of heights (*.tif)"}, options.folder);
  arguments.positive({"--fps", "Frames a second (5)"}, options.fps);
  arguments.positive({"--group", "Frames of a group (4)"}, options.group);
  arguments.positive({"--reference", "Bytes of a frame that every receiver gets (1200)"},
                     options.reference);
  arguments.positive({"--key", "Differences begin anew after so many frames (40)"}, options.key);
  arguments.text({"--frames", "Write PSNR over time to a CSV file"}, options.csv);
  if (const std::optional<int> code = arguments.parse(argc, argv)) return *code;
  return exitCode(run(options));
}
