// SPDX-License-Identifier: Apache-2.0
// tetrakis synth: a deterministic sample terrain and its texture.
#include <memory>
#include <string>

#include "tools/command.hpp"
#include "tools/output.hpp"
#include "tools/synth.hpp"

namespace tetrakis::tools {
namespace {

struct SynthArguments {
  std::string folder;
  SynthOptions options;
  bool force = false;
};

Status synth(const SynthArguments& arguments) {
  const Result<OutputFolder> folder = OutputFolder::create(arguments.folder);
  if (!folder.ok()) return folder.status();
  Result<Output> height = Output::plan(folder->file("height.tif"), arguments.force, ".tif");
  if (!height.ok()) return height.status();
  Result<Output> texture = Output::plan(folder->file("texture.png"), arguments.force, ".png");
  if (!texture.ok()) return texture.status();
  const SynthTerrain terrain = synthesize(arguments.options);
  if (Status status = height->stage(
          [&](const std::string& path) { return writeHeights(path, terrain.heights); });
      !status.ok())
    return status;
  if (Status status = texture->stage(
          [&](const std::string& path) { return writeImage(path, terrain.texture); });
      !status.ok())
    return status;
  if (Status status = height->commit(); !status.ok()) return status;
  return texture->commit();
}

}  // namespace

void addSynth(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<SynthArguments>();
  CLI::App& verb = *app.add_subcommand("synth", "Make a sample terrain with its texture");
  verb.add_option("-o,--output", arguments->folder, "Folder for height.tif and texture.png")
      ->required()
      ->type_name("DIR");
  verb.add_option("--size", arguments->options.size, "Samples along a side")
      ->capture_default_str()
      ->check(silent(CLI::Range(2u, 8193u)))
      ->type_name("N");
  verb.add_option("--seed", arguments->options.seed, "Another seed, another terrain")
      ->capture_default_str()
      ->type_name("S");
  addForce(verb, arguments->force);
  verb.callback([arguments, &line] { line.action = [arguments] { return synth(*arguments); }; });
}

}  // namespace tetrakis::tools
