// SPDX-License-Identifier: Apache-2.0
// tetrakis combine: one stream of the components of several.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
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

struct CombineArguments {
  std::vector<std::string> inputs, weights;
  std::string output;
  uint64_t bytes = 0;
  bool force = false;
};

/// A stream, and what its components are called.
struct NamedInput {
  std::string name, path;
  double weight = 0;  ///< 0: as the first stream
  std::vector<std::byte> bytes = {};
};

/// NAME=VALUE, or a value alone: a file whose name has an equals sign is a file.
NamedInput named(const std::string& given) {
  const size_t sign = given.find('=');
  std::error_code ignored;
  if (sign == std::string::npos || std::filesystem::exists(given, ignored)) return {"", given};
  return {given.substr(0, sign), given.substr(sign + 1)};
}

Status takeWeight(const std::string& given, std::vector<NamedInput>& inputs) {
  const size_t sign = given.find('=');
  const Status wrong(TKS_USAGE, "--weight " + quoted(given) +
                                    " is none: write for example --weight normals=0.5");
  if (sign == std::string::npos) return wrong;
  double weight = 0;
  const char *begin = given.data() + sign + 1, *end = given.data() + given.size();
  const auto [rest, error] = std::from_chars(begin, end, weight);
  if (error != std::errc() || rest != end || !(weight > 0) || std::isinf(weight)) return wrong;
  const std::string name = given.substr(0, sign);
  const auto found = std::find_if(inputs.begin(), inputs.end(),
                                  [&](const NamedInput& input) { return input.name == name; });
  if (found == inputs.end()) return {TKS_USAGE, "no stream is called " + quoted(name)};
  found->weight = weight;
  return {};
}

Result<std::vector<NamedInput>> readInputs(const CombineArguments& arguments) {
  std::vector<NamedInput> inputs;
  for (const std::string& given : arguments.inputs) inputs.push_back(named(given));
  for (const std::string& weight : arguments.weights)
    if (Status status = takeWeight(weight, inputs); !status.ok()) return status;
  for (NamedInput& input : inputs) {
    const std::string& path = input.path;
    Result<std::vector<std::byte>> bytes = readBytes(path);
    if (!bytes.ok()) return bytes.status();
    input.bytes = *std::move(bytes);
    if (isSequence(input.bytes))
      return Status(TKS_USAGE, quoted(path) + " is a sequence: only streams are combined");
  }
  return inputs;
}

/// The library counts streams; people name files.
Status aboutFile(const Status& status, const std::vector<NamedInput>& inputs) {
  const std::string& message = status.message();
  for (size_t i = 0; i < inputs.size(); ++i) {
    const std::string number = "Stream " + std::to_string(i) + ": ";
    if (message.rfind(number, 0) == 0)
      return {status.code(), quoted(inputs[i].path) + ": " + message.substr(number.size())};
  }
  return status;
}

Status combineFiles(const CombineArguments& arguments) {
  std::vector<std::string> paths;
  for (const std::string& given : arguments.inputs) paths.push_back(named(given).path);
  if (Status stays = checkInputsStay(paths, arguments.output); !stays.ok()) return stays;
  Result<Output> output = Output::plan(arguments.output, arguments.force, ".tks");
  if (!output.ok()) return output.status();
  const Result<std::vector<NamedInput>> inputs = readInputs(arguments);
  if (!inputs.ok()) return inputs.status();
  std::vector<tks_combined> streams;
  for (const NamedInput& input : *inputs) {
    const std::span<const uint8_t> bytes = octets(input.bytes);
    streams.push_back({sizeof(tks_combined), bytes.data(), bytes.size(), input.name.c_str(),
                       input.weight});
  }
  const tks_limits limits = limitsOfTools();
  const Result<Buffer> combined =
      combine(streams, {sizeof(tks_combine_options), arguments.bytes, &limits});
  if (!combined) return aboutFile(combined.status(), *inputs);
  if (Status status = output->stage(std::as_bytes(combined->bytes())); !status.ok()) return status;
  return output->commit();
}

}  // namespace

void addCombine(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<CombineArguments>();
  CLI::App& verb =
      *app.add_subcommand("combine", "Make one stream of the components of several");
  verb.add_option("IN", arguments->inputs,
                  "Streams (.tks); NAME=IN names the components of one")
      ->required()
      ->type_name("[NAME=]IN...");
  addBytes(verb, arguments->bytes, "Keep so many bytes: 65536, 64k, 1M")->check(positive());
  verb.add_option("--weight", arguments->weights,
                  "What the errors of a stream count beside those of others, by its name (1)")
      ->type_name("NAME=W")
      ->expected(1)
      ->take_all();
  verb.add_option("-o,--output", arguments->output, "Where to write; - is standard output")
      ->required()
      ->type_name("OUT.tks");
  addForce(verb, arguments->force);
  verb.callback(
      [arguments, &line] { line.action = [arguments] { return combineFiles(*arguments); }; });
}

}  // namespace tetrakis::tools
