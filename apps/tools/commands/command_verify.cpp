// SPDX-License-Identifier: Apache-2.0
// tetrakis verify: the strict syntax of one stream, or all conformance vectors of a folder.
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/output/json.hpp"
#include "conformance/runner.hpp"

namespace tetrakis::tools {
namespace {

/// Every group.
Status verifySequence(const std::string& path, std::span<const uint8_t> bytes, bool quiet) {
  Result<Sequence> sequence = Sequence::open(bytes, limitsOfTools());
  if (!sequence) return sequence.status();
  const tks_sequence_info info = sequence->info();
  if (info.whole_bytes < bytes.size())
    return Status(TKS_TRUNCATED, quoted(path) + " ends inside a group");
  for (uint64_t frame = info.first_frame; frame < info.end_frame;) {
    const Result<tks_group> group = sequence->group(frame);
    if (!group) return group.status();
    Result<Decoder> decoder = sequence->decoder(frame);
    Status status = decoder ? decoder->verify() : decoder.status();
    if (!status.ok())
      return Status(status.code(),
                    "the group of frame " + std::to_string(frame) + ": " + status.message());
    frame += group->frames;
  }
  if (quiet) return Status();
  return print(quoted(path) + ": valid, " + std::to_string(bytes.size()) + " bytes, " +
               counted(info.end_frame - info.first_frame, "frame", "frames") + " in " +
               counted(info.groups, "group", "groups") + "\n");
}

Status verifyStream(const std::string& path, bool quiet) {
  const Result<std::vector<std::byte>> bytes = readBytes(path);
  if (!bytes.ok()) return bytes.status();
  if (isSequence(*bytes)) return verifySequence(path, octets(*bytes), quiet);
  const Result<OpenStream> stream = openStream({path, std::nullopt, true});
  if (!stream.ok()) return stream.status();
  if (quiet) return Status();
  const tks_info& info = stream->decoder.info();
  return print(quoted(path) + ": valid, " + std::to_string(info.stream_bytes) + " bytes, " +
               counted(info.packets, "packet", "packets") + "\n");
}

Status verifyVectors(const std::string& folder, bool quiet) {
  std::ostream silent(nullptr);
  const auto summary = conformance::runVectors(folder, quiet ? silent : std::cerr);
  if (!summary.ok()) return summary.status();
  const std::string passed = std::to_string(summary->passed);
  if (summary->failed > 0)
    return Status(TKS_MISMATCH, quoted(folder) + ": " + std::to_string(summary->failed) +
                                    " conformance vectors failed, " + passed + " passed");
  return quiet ? Status() : print(quoted(folder) + ": " + passed + " conformance vectors passed\n");
}

Status verify(const std::string& path, bool quiet) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored) ? verifyVectors(path, quiet)
                                                      : verifyStream(path, quiet);
}

}  // namespace

void addVerify(CLI::App& app, CommandLine& line) {
  const auto path = std::make_shared<std::string>();
  CLI::App& verb =
      *app.add_subcommand("verify", "Check a whole stream, or run conformance vectors");
  verb.add_option("IN", *path, "Stream (.tks), - for standard input, or a folder of vectors")
      ->required()
      ->type_name("");
  verb.callback(
      [path, &line] { line.action = [path, &line] { return verify(*path, line.quiet); }; });
}

}  // namespace tetrakis::tools
