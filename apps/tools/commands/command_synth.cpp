// SPDX-License-Identifier: Apache-2.0
// tetrakis synth: a deterministic sample terrain, its texture and its map; or a sample surface.
#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/synth/frames.hpp"
#include "apps/tools/synth/surfaces/synth_surface.hpp"
#include "apps/tools/synth/synth.hpp"
#include "base/parallel.hpp"

namespace tetrakis::tools {
namespace {

constexpr uint32_t kUsualFrames = 16;

struct SynthArguments {
  std::string output;
  std::string kind = kSynthKinds[0];
  std::optional<uint32_t> size, triangles, frames;
  uint64_t seed = 1;
  bool force = false;
};

Status synthTerrain(const SynthArguments& arguments, SynthKind kind) {
  const Result<OutputFolder> folder = OutputFolder::create(arguments.output);
  if (!folder.ok()) return folder.status();
  std::vector<Output> outputs;
  for (const char* name : {"height.tif", "texture.png", "map.png"}) {
    Result<Output> output =
        Output::plan(folder->file(name), arguments.force, std::filesystem::path(name).extension());
    if (!output.ok()) return output.status();
    outputs.push_back(std::move(*output));
  }
  SynthOptions options;
  options.size = arguments.size.value_or(options.size);
  options.seed = arguments.seed;
  options.kind = kind;
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

Status synthSurface(const SynthArguments& arguments, SynthSurfaceKind kind) {
  Result<Output> output = Output::plan(arguments.output, arguments.force, ".glb");
  if (!output.ok()) return output.status();
  const std::string format = std::filesystem::path(output->name()).extension();
  if (format != ".glb" && format != ".obj" && format != ".ply")
    return {TKS_USAGE, "a surface is written to a .glb, .obj or .ply"};
  SynthSurfaceOptions options;
  options.kind = kind;
  options.triangles = arguments.triangles.value_or(options.triangles);
  options.seed = arguments.seed;
  SynthSurface surface = synthesizeSurface(options);
  if (format != ".ply") surface.mesh.texture = &surface.texture;
  const Status written =
      output->stage([&surface](const std::string& path) { return writeMesh(path, surface.mesh); });
  return written.ok() ? output->commit() : written;
}

/// "frame-007.tif".
std::string frameName(uint32_t frame, const char* extension) {
  const std::string digits = std::to_string(frame);
  return "frame-" + std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits +
         extension;
}

Status synthFrames(const SynthArguments& arguments, FrameKind kind) {
  const Result<OutputFolder> folder = OutputFolder::create(arguments.output);
  if (!folder.ok()) return folder.status();
  SynthOptions options;
  options.size = arguments.size.value_or(options.size);
  options.seed = arguments.seed;
  const auto write = [&](uint32_t frame, const HeightFile* heights,
                         const ImageFile* texture) -> Status {
    const char* const extension = heights != nullptr ? ".tif" : ".png";
    Result<Output> output =
        Output::plan(folder->file(frameName(frame, extension)), arguments.force, extension);
    if (!output.ok()) return output.status();
    const Status written = output->stage([&](const std::string& path) {
      return heights != nullptr ? writeHeights(path, *heights) : writeImage(path, *texture);
    });
    return written.ok() ? output->commit() : written;
  };
  return synthesizeFrames(options, kind, arguments.frames.value_or(kUsualFrames), write);
}

/// Nothing if it is none of the names.
template <class Kind, size_t kCount>
std::optional<Kind> kindNamed(const std::string& name,
                              const std::array<const char*, kCount>& names) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Kind>(found - names.begin());
}

Status synth(const SynthArguments& arguments) {
  const auto frames = kindNamed<FrameKind>(arguments.kind, kFrameKinds);
  if (!frames && arguments.frames)
    return {TKS_USAGE, "--frames is of what changes over time: erosion, flood, clouds, rover"};
  if (frames && arguments.triangles)
    return {TKS_USAGE, "--triangles is of surfaces; frames have --size"};
  if (frames) return synthFrames(arguments, *frames);
  const auto surface = kindNamed<SynthSurfaceKind>(arguments.kind, kSynthSurfaces);
  if (surface && arguments.size)
    return {TKS_USAGE, "--size is of terrain; a surface has --triangles"};
  if (!surface && arguments.triangles)
    return {TKS_USAGE, "--triangles is of surfaces; a terrain has --size"};
  if (surface) return synthSurface(arguments, *surface);
  return synthTerrain(arguments, *kindNamed<SynthKind>(arguments.kind, kSynthKinds));
}

std::vector<std::string> allKinds() {
  std::vector<std::string> all(kSynthKinds.begin(), kSynthKinds.end());
  all.insert(all.end(), kSynthSurfaces.begin(), kSynthSurfaces.end());
  all.insert(all.end(), kFrameKinds.begin(), kFrameKinds.end());
  return all;
}

}  // namespace

void addSynth(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<SynthArguments>();
  CLI::App& verb = *app.add_subcommand(
      "synth", "Make a sample terrain with its texture and map, or a sample surface");
  verb.add_option(
          "-o,--output", arguments->output,
          "Folder for height.tif, texture.png and map.png, or for frames; of a surface, its "
          ".glb, .obj or .ply")
      ->required()
      ->type_name("OUT");
  verb.add_option("--size", arguments->size, "Samples along a side of a terrain (513)")
      ->check(silent(CLI::Range(2u, 8193u)))
      ->type_name("N");
  verb.add_option("--triangles", arguments->triangles, "Of a surface, about (20000)")
      ->check(silent(CLI::Range(20u, 4000000u)))
      ->type_name("N");
  verb.add_option("--frames", arguments->frames, "Of what changes over time, so many (16)")
      ->check(silent(CLI::Range(1u, 10000u)))
      ->type_name("N");
  verb.add_option("--seed", arguments->seed, "Another seed, another terrain or surface (1)")
      ->type_name("S");
  verb.add_option(
          "--kind", arguments->kind,
          "Of terrain: mountains (default), coast, lakes, steps, voids, plain, city, rescaled, "
          "bands, geoid, mosaic, turned, facets, smooth; of surfaces: blob, knot, scan; over time: "
          "erosion, flood, clouds, rover")
      ->check(silent(CLI::IsMember(allKinds())))
      ->type_name("NAME");
  addForce(verb, arguments->force);
  verb.callback([arguments, &line] { line.action = [arguments] { return synth(*arguments); }; });
}

}  // namespace tetrakis::tools
