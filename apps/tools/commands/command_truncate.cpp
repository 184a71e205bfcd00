// SPDX-License-Identifier: Apache-2.0
// tetrakis truncate: the first bytes of a stream, which are a stream.
#include <memory>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/output/output_names.hpp"

namespace tetrakis::tools {
namespace {

struct TruncateArguments {
  StreamSource source;
  std::string output;
  bool force = false;
};

Status truncate(const TruncateArguments& arguments) {
  Status stays = checkInputsStay({arguments.source.path}, arguments.output);
  if (!stays.ok()) return stays;
  Result<Output> output = Output::plan(arguments.output, arguments.force, ".tks");
  if (!output.ok()) return output.status();
  const Result<std::vector<std::byte>> bytes = readCut(arguments.source);
  if (!bytes.ok()) return bytes.status();
  if (Status status = output->stage(*bytes); !status.ok()) return status;
  return output->commit();
}

}  // namespace

void addTruncate(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<TruncateArguments>();
  CLI::App& verb = *app.add_subcommand("truncate", "Cut a stream to a number of bytes");
  addSource(verb, arguments->source);
  verb.get_option("--bytes")->required()->description("Keep so many bytes: 65536, 64k, 1M");
  verb.add_option("-o,--output", arguments->output, "Where to write; - is standard output")
      ->required()
      ->type_name("OUT.tks");
  addForce(verb, arguments->force);
  verb.callback([arguments, &line] { line.action = [arguments] { return truncate(*arguments); }; });
}

}  // namespace tetrakis::tools
