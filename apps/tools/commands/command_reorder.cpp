// SPDX-License-Identifier: Apache-2.0
// tetrakis reorder: the packets of a stream in the order that serves given cameras.
#include <memory>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/output/output_names.hpp"
#include "apps/tools/report/globe_mesh.hpp"
#include "apps/tools/report/viewed_mesh.hpp"

namespace tetrakis::tools {
namespace {

struct ReorderArguments {
  StreamSource source;
  CameraChoice cameras;
  std::string output;
  double exaggeration = 1;
  bool globe = false, force = false;
};

Result<Buffer> reordered(Decoder& decoder, const ReorderArguments& arguments) {
  if (arguments.globe) {
    const Result<tks_globe> globe = globeOf(decoder.info(), arguments.exaggeration);
    if (!globe.ok()) return globe.status();
    const auto cameras = globeCameras(decoder, arguments.cameras, *globe);
    if (!cameras.ok()) return cameras.status();
    return decoder.reordered(*cameras);
  }
  if (isGridOnCube(decoder.info()))
    return Status(TKS_USAGE, "the heights lie on a cube: give --globe, and --cameras of a globe");
  const auto cameras = meshCameras(decoder, arguments.cameras);
  if (!cameras.ok()) return cameras.status();
  return decoder.reordered(*cameras);
}

Status reorder(const ReorderArguments& arguments) {
  if (arguments.cameras.isDefault())
    return Status(TKS_USAGE, "nothing to serve: give --cameras or --view");
  if (arguments.exaggeration == 0)
    return Status(TKS_USAGE, "--exaggeration 0 would leave no relief: give another number");
  Status stays = checkInputsStay({arguments.source.path}, arguments.output);
  if (!stays.ok()) return stays;
  Result<Output> output = Output::plan(arguments.output, arguments.force, ".tks");
  if (!output.ok()) return output.status();
  Result<OpenStream> stream = openTerrain(arguments.source);
  if (!stream.ok()) return stream.status();
  Decoder& decoder = stream->decoder;
  decoder.setThreads(hardwareThreads());
  const Result<Buffer> served = reordered(decoder, arguments);
  if (!served) return served.status();
  const auto bytes = std::as_bytes(served->bytes());
  if (Status status = output->stage(bytes); !status.ok()) return status;
  return output->commit();
}

}  // namespace

void addReorder(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<ReorderArguments>();
  CLI::App& verb =
      *app.add_subcommand("reorder", "Put the packets in the order that serves cameras");
  addSource(verb, arguments->source);
  addCameraOptions(verb, arguments->cameras);
  CLI::Option* const globe = verb.add_flag(
      "--globe", arguments->globe, "The cameras look at a globe, with places from its centre");
  verb.add_option("--exaggeration", arguments->exaggeration,
                  "What heights on the globe are multiplied by (default: 1)")
      ->type_name("X")
      ->needs(globe);
  verb.add_option("-o,--output", arguments->output, "Where to write; - is standard output")
      ->required()
      ->type_name("OUT.tks");
  addForce(verb, arguments->force);
  verb.callback([arguments, &line] { line.action = [arguments] { return reorder(*arguments); }; });
}

}  // namespace tetrakis::tools
