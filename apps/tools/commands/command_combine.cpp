// SPDX-License-Identifier: Apache-2.0
// tetrakis combine: one stream of the components of several.
#include <memory>
#include <string>
#include <vector>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/named_files.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/positive.hpp"
#include "apps/tools/files/stream.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/output/output_names.hpp"

namespace tetrakis::tools {
namespace {

struct CombineArguments {
  std::vector<std::string> inputs, weights;
  std::string output;
  uint64_t bytes = 0;
  bool force = false;
};

Result<std::vector<std::byte>> readStream(const std::string& path) {
  Result<std::vector<std::byte>> bytes = readBytes(path);
  if (bytes.ok() && isSequence(*bytes))
    return Status(TKS_USAGE, quoted(path) + " is a sequence: only streams are combined");
  return bytes;
}

Status combineFiles(const CombineArguments& arguments) {
  std::vector<NamedFile> files = namedFiles(arguments.inputs);
  if (Status status = takeWeights(arguments.weights, files); !status.ok()) return status;
  std::vector<std::string> paths;
  for (const NamedFile& file : files) paths.push_back(file.path);
  if (Status stays = checkInputsStay(paths, arguments.output); !stays.ok()) return stays;
  Result<Output> output = Output::plan(arguments.output, arguments.force, ".tks");
  if (!output.ok()) return output.status();
  std::vector<std::vector<std::byte>> bytes;
  std::vector<tks_combined> streams;
  for (const NamedFile& file : files) {
    Result<std::vector<std::byte>> read = readStream(file.path);
    if (!read.ok()) return read.status();
    bytes.push_back(*std::move(read));
    streams.push_back(asCombined(file, octets(bytes.back())));
  }
  const tks_limits limits = limitsOfTools();
  const Result<Buffer> combined =
      combine(streams, {sizeof(tks_combine_options), arguments.bytes, &limits});
  if (!combined) return aboutFile(combined.status(), files);
  if (Status status = output->stage(std::as_bytes(combined->bytes())); !status.ok()) return status;
  return output->commit();
}

}  // namespace

void addCombine(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<CombineArguments>();
  CLI::App& verb = *app.add_subcommand("combine", "Make one stream of the components of several");
  verb.add_option("IN", arguments->inputs, "Streams (.tks); NAME=IN names the components of one")
      ->required()
      ->type_name("[NAME=]IN...");
  addBytes(verb, arguments->bytes, "Keep so many bytes: 65536, 64k, 1M")->check(positive());
  addWeights(verb, "--weight", arguments->weights);
  verb.add_option("-o,--output", arguments->output, "Where to write; - is standard output")
      ->required()
      ->type_name("OUT.tks");
  addForce(verb, arguments->force);
  verb.callback(
      [arguments, &line] { line.action = [arguments] { return combineFiles(*arguments); }; });
}

}  // namespace tetrakis::tools
