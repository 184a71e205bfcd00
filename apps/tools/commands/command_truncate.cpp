// SPDX-License-Identifier: Apache-2.0
// tetrakis truncate: the first bytes of a stream, which are a stream.
#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/positive.hpp"
#include "apps/tools/files/stream.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/output/output_names.hpp"

namespace tetrakis::tools {
namespace {

struct TruncateArguments {
  StreamSource source;
  std::string output;
  uint64_t rate = 0;  ///< bytes a second of a sequence; 0: `source` says how many
  bool force = false;
};

/// The groups of a sequence, each cut to its share.
Result<std::vector<std::byte>> thinned(const TruncateArguments& arguments) {
  const Result<std::vector<std::byte>> bytes = readBytes(arguments.source.path);
  if (!bytes.ok()) return bytes;
  if (!isSequence(*bytes))
    return Status(TKS_USAGE, "--rate is for sequences; " + quoted(arguments.source.path) +
                                 " is one stream: give --bytes");
  const Result<Sequence> sequence = Sequence::open(octets(*bytes), limitsOfTools());
  if (!sequence) return sequence.status();
  const tks_sequence_info info = sequence->info();
  if (info.end_frame < info.first_frame + 2 || info.clock.numerator == 0)
    return Status(TKS_USAGE, "the sequence does not say how long its frames last");
  const double ticks = static_cast<double>(*sequence->time(info.end_frame - 1)) -
                       static_cast<double>(*sequence->time(info.first_frame));
  const double seconds = ticks / static_cast<double>(info.end_frame - info.first_frame - 1) *
                         static_cast<double>(info.clock.numerator) /
                         static_cast<double>(info.clock.denominator);
  const double frame = std::clamp(static_cast<double>(arguments.rate) * seconds, 1., 1e15);
  const Result<Buffer> thin = sequence->thinned(static_cast<uint64_t>(frame));
  if (!thin) return thin.status();
  const auto all = std::as_bytes(thin->bytes());
  return std::vector<std::byte>(all.begin(), all.end());
}

Status truncate(const TruncateArguments& arguments) {
  Status stays = checkInputsStay({arguments.source.path}, arguments.output);
  if (!stays.ok()) return stays;
  Result<Output> output = Output::plan(arguments.output, arguments.force, ".tks");
  if (!output.ok()) return output.status();
  const Result<std::vector<std::byte>> bytes =
      arguments.rate > 0 ? thinned(arguments) : readCut(arguments.source);
  if (!bytes.ok()) return bytes.status();
  if (Status status = output->stage(*bytes); !status.ok()) return status;
  return output->commit();
}

}  // namespace

void addTruncate(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<TruncateArguments>();
  CLI::App& verb = *app.add_subcommand("truncate", "Cut a stream to a number of bytes");
  addSource(verb, arguments->source);
  CLI::Option* const bytes =
      verb.get_option("--bytes")->description("Keep so many bytes: 65536, 64k, 1M");
  addSize(verb, "--rate", arguments->rate, "Of a sequence, so many bytes a second of each group")
      ->check(positive())
      ->excludes(bytes);
  verb.add_option("-o,--output", arguments->output, "Where to write; - is standard output")
      ->required()
      ->type_name("OUT.tks");
  addForce(verb, arguments->force);
  verb.callback([arguments, bytes, &line] {
    if (bytes->count() == 0 && arguments->rate == 0) throw CLI::RequiredError("--bytes or --rate");
    line.action = [arguments] { return truncate(*arguments); };
  });
}

}  // namespace tetrakis::tools
