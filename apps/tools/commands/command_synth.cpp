// SPDX-License-Identifier: Apache-2.0
// tetrakis synth: a deterministic sample terrain, its texture and its map.
#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/synth/synth.hpp"
#include "base/parallel.hpp"

namespace tetrakis::tools {
namespace {

struct SynthArguments {
  std::string folder;
  SynthOptions options;
  std::string kind = kSynthKinds[0];
  bool force = false;
};

Status synth(const SynthArguments& arguments) {
  const Result<OutputFolder> folder = OutputFolder::create(arguments.folder);
  if (!folder.ok()) return folder.status();
  std::vector<Output> outputs;
  for (const char* name : {"height.tif", "texture.png", "map.png"}) {
    Result<Output> output =
        Output::plan(folder->file(name), arguments.force, std::filesystem::path(name).extension());
    if (!output.ok()) return output.status();
    outputs.push_back(std::move(*output));
  }
  SynthOptions options = arguments.options;
  const auto kind = std::find(kSynthKinds.begin(), kSynthKinds.end(), arguments.kind);
  options.kind = static_cast<SynthKind>(kind - kSynthKinds.begin());
  const SynthTerrain terrain = synthesize(options);
  const std::array<std::function<Status(const std::string&)>, 3> writers = {
      [&](const std::string& path) { return writeHeights(path, terrain.heights); },
      [&](const std::string& path) { return writeImage(path, terrain.texture); },
      [&](const std::string& path) { return writeImage(path, terrain.map); }};
  std::array<Status, 3> written;
  parallelFor(std::thread::hardware_concurrency(), written.size(),
              [&](size_t i) { written[i] = outputs[i].stage(writers[i]); });
  for (const Status& status : written) {
    if (!status.ok()) return status;
  }
  for (Output& output : outputs) {
    if (Status status = output.commit(); !status.ok()) return status;
  }
  return {};
}

}  // namespace

void addSynth(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<SynthArguments>();
  CLI::App& verb = *app.add_subcommand("synth", "Make a sample terrain with its texture and map");
  verb.add_option("-o,--output", arguments->folder,
                  "Folder for height.tif, texture.png and map.png")
      ->required()
      ->type_name("DIR");
  verb.add_option("--size", arguments->options.size, "Samples along a side (513)")
      ->check(silent(CLI::Range(2u, 8193u)))
      ->type_name("N");
  verb.add_option("--seed", arguments->options.seed, "Another seed, another terrain (1)")
      ->type_name("S");
  verb.add_option(
          "--kind", arguments->kind,
          "Of terrain: mountains (default), coast, lakes, steps, voids, plain, city, rescaled, "
          "bands, geoid, mosaic, turned, facets")
      ->check(
          silent(CLI::IsMember(std::vector<std::string>(kSynthKinds.begin(), kSynthKinds.end()))))
      ->type_name("NAME");
  addForce(verb, arguments->force);
  verb.callback([arguments, &line] { line.action = [arguments] { return synth(*arguments); }; });
}

}  // namespace tetrakis::tools
