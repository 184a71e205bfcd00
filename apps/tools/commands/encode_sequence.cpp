// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/encode_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <optional>
#include <utility>

#include "apps/tools/commands/encode_inputs.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/frame_files.hpp"
#include "apps/tools/files/stream.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/output/output_names.hpp"
#include "apps/tools/output/progress.hpp"
#include "tetrakis/sequence.hpp"

namespace tetrakis::tools {
namespace {

EncodeArguments argumentsOf(EncodeArguments arguments, const FrameNames& names, size_t frame) {
  arguments.height = names.height(frame);
  arguments.texture = names.texture(frame);
  return arguments;
}

/// Seconds between frames; nothing where nobody says.
std::optional<double> secondsOf(const SequenceArguments& arguments) {
  if (arguments.fps > 0) return 1 / arguments.fps;
  return arguments.every > 0 ? std::optional(arguments.every) : std::nullopt;
}

/// A frame a tick. Three decimals are exact.
Result<tks_clock> clockOf(const SequenceArguments& arguments) {
  tks_clock clock = {};
  clock.size = sizeof clock;
  const double given = arguments.fps > 0 ? arguments.fps : arguments.every;
  if (!(given > 0)) {
    if (arguments.epoch.empty() && arguments.calendar.empty()) return clock;
    return Status(TKS_USAGE, "--epoch and --calendar take --fps or --every");
  }
  const double thousandths = std::round(given * 1000);
  if (!(thousandths >= 1 && thousandths < 1e15) || thousandths / 1000 != given)
    return Status(TKS_USAGE, "--fps and --every take at most three decimals");
  const auto count = static_cast<uint64_t>(thousandths);
  const uint64_t common = std::gcd(count, uint64_t{1000});
  clock.numerator = (arguments.fps > 0 ? 1000 : count) / common;
  clock.denominator = (arguments.fps > 0 ? count : 1000) / common;
  if (!arguments.epoch.empty()) clock.epoch = arguments.epoch.c_str();
  if (!arguments.calendar.empty()) clock.calendar = arguments.calendar.c_str();
  return clock;
}

/// The bytes of a frame, of those of a second or of all frames; 0: there is another target.
Result<uint64_t> frameBytes(const EncodeArguments& arguments, size_t frames) {
  if (arguments.bytes > 0) return std::max<uint64_t>(1, arguments.bytes / frames);
  if (arguments.sequence.rate == 0) return uint64_t{0};
  const std::optional<double> seconds = secondsOf(arguments.sequence);
  if (!seconds) return Status(TKS_USAGE, "--rate takes --fps or --every");
  const double bytes = static_cast<double>(arguments.sequence.rate) * *seconds;
  return static_cast<uint64_t>(std::clamp(bytes, 1., 1e15));
}

/// Encodes the frames, and writes what is ready behind each.
class SequenceWriting {
 public:
  SequenceWriting(const EncodeArguments& arguments, const FrameNames& names, bool quiet)
      : arguments_(arguments), names_(names), quiet_(quiet) {}

  Status write(const std::string& path) {
    std::ofstream file(path, std::ios::binary);
    return writeAll(file, path);
  }

  /// Adds groups to the sequence that a file is. What it had stays whatever happens.
  Status append(const std::string& path) {
    const Result<std::vector<std::byte>> bytes = readBytes(path);
    if (!bytes.ok()) return bytes.status();
    const Result<Sequence> all = Sequence::open(octets(*bytes), limitsOfTools());
    if (!all) return all.status();
    const auto whole = static_cast<size_t>(all->info().whole_bytes);
    if (whole < bytes->size())
      tellNote(quoted(path) + " ended inside a group: " + std::to_string(bytes->size() - whole) +
                   " bytes of it are gone",
               quiet_);
    Result<Sequence> written = Sequence::open(octets(*bytes).first(whole), limitsOfTools());
    if (!written) return written.status();
    before_ = std::move(*written);
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(whole));
    const Status status = writeAll(file, path);
    file.close();
    std::error_code error;
    std::filesystem::resize_file(path, whole + bytes_, error);
    if (status.ok() && error) return Status(TKS_IO, "cannot write " + quoted(path));
    return status;
  }
  uint64_t bytes() const { return bytes_; }

 private:
  Status writeAll(std::ostream& file, const std::string& path) {
    Progress progress("encoding", quiet_);
    for (size_t t = 0; t < names_.count(); ++t) {
      if (Status status = push(t); !status.ok()) return status;
      if (Status status = writeReady(file, path); !status.ok()) return status;
      Progress::report(&progress, static_cast<double>(t + 1) / static_cast<double>(names_.count()));
    }
    if (Status status = encoder_->flush(); !status.ok()) return status;
    return writeReady(file, path);
  }

  /// The time of a frame: frames of a file that is added to come behind its last one.
  int64_t tickOf(size_t frame) const {
    const auto number = static_cast<int64_t>(frame);
    if (!before_) return number;
    return *before_->time(before_->info().end_frame - 1) + 1 + number;
  }

  Status push(size_t frame) {
    const EncodeArguments arguments = argumentsOf(arguments_, names_, frame);
    const Result<Reference> inputs = readInputs(arguments, quiet_ || frame > 0);
    if (!inputs.ok()) return inputs.status();
    if (!encoder_) {
      if (Status status = begin(arguments, *inputs); !status.ok()) return status;
    }
    tks_heights heights = {};
    if (inputs->heights) heights = encodedHeights(arguments, *inputs->heights);
    const tks_image image = inputs->image ? asImage(*inputs->image) : tks_image{};
    Status status = encoder_->push(inputs->heights ? &heights : nullptr,
                                   inputs->image ? &image : nullptr, tickOf(frame));
    if (status.ok()) return status;
    const std::string& name = inputs->heights ? arguments.height : arguments.texture;
    return Status(status.code(), quoted(name) + ": " + status.message());
  }

  Status begin(const EncodeArguments& arguments, const Reference& first) {
    Result<tks_encode_options> options = encodeOptions(arguments, first);
    if (!options.ok()) return options.status();
    const Result<uint64_t> bytes = frameBytes(arguments_, names_.count());
    if (!bytes.ok()) return bytes.status();
    options->bytes = *bytes;
    const Result<tks_clock> clock = clockOf(arguments_.sequence);
    if (!clock.ok()) return clock.status();
    tks_sequence_options sequence = makeSequenceOptions();
    sequence.group = arguments_.sequence.group;
    sequence.encode = &*options;
    sequence.clock = before_ && !clockGiven() ? before_->info().clock : *clock;
    sequence.reference = arguments_.sequence.reference;
    sequence.entry = arguments_.sequence.entry;
    Result<SequenceEncoder> encoder = SequenceEncoder::open(sequence);
    if (!encoder) return encoder.status();
    encoder_ = std::move(*encoder);
    return before_ ? encoder_->goOnBehind(before_->get()) : Status();
  }

  bool clockGiven() const {
    const SequenceArguments& given = arguments_.sequence;
    return given.fps > 0 || given.every > 0 || !given.epoch.empty() || !given.calendar.empty();
  }

  Status writeReady(std::ostream& file, const std::string& path) {
    const Result<Buffer> ready = encoder_->take();
    if (!ready) return ready.status();
    const std::span<const uint8_t> bytes = ready->bytes();
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) return Status(TKS_IO, "cannot write " + quoted(path));
    bytes_ += bytes.size();
    return Status();
  }

  const EncodeArguments& arguments_;
  const FrameNames& names_;
  bool quiet_;
  std::optional<Sequence> before_;  ///< that the frames are added to
  std::optional<SequenceEncoder> encoder_;
  uint64_t bytes_ = 0;
};

Status checkSequence(const EncodeArguments& arguments) {
  const std::pair<const char*, bool> others[] = {
      {"--report", !arguments.report.empty()},
      {"--also", !arguments.also.empty()},
      {"--explain", arguments.explain},
      {"--triangles", arguments.triangles > 0},
      {"--domain cube", arguments.domain == "cube"},
      {"--engine", arguments.engine != "modelled"},
      {"--weights", arguments.weights != "psnr"},
      {"--cameras or --view", !arguments.cameras.isDefault()}};
  for (const auto& [name, given] : others)
    if (given) return Status(TKS_USAGE, std::string(name) + " is not for sequences");
  return Status();
}

Status writeNew(const EncodeArguments& arguments, SequenceWriting& writing) {
  Result<Output> output = Output::plan(arguments.output, arguments.force, ".tks");
  if (!output.ok()) return output.status();
  const Status written =
      output->stage([&](const std::string& path) { return writing.write(path); });
  return written.ok() ? output->commit() : written;
}

}  // namespace

bool isSequence(const EncodeArguments& arguments) {
  return isPattern(arguments.height) || isPattern(arguments.texture);
}

Status encodeSequence(const EncodeArguments& arguments, bool quiet) {
  if (Status status = checkSequence(arguments); !status.ok()) return status;
  const Result<FrameNames> names = frameNames(arguments.height, arguments.texture);
  if (!names.ok()) return names.status();
  std::vector<std::string> inputs = names->heights;
  inputs.insert(inputs.end(), names->textures.begin(), names->textures.end());
  if (Status status = checkInputsStay(inputs, arguments.output); !status.ok()) return status;
  SequenceWriting writing(arguments, *names, quiet);
  const Status written =
      arguments.sequence.append ? writing.append(arguments.output) : writeNew(arguments, writing);
  if (!written.ok()) return written;
  if (!quiet)
    tellLine(arguments.output + ": " + std::to_string(names->count()) + " frames, " +
             std::to_string(writing.bytes()) + " bytes");
  return Status();
}

}  // namespace tetrakis::tools
