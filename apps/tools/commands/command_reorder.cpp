// SPDX-License-Identifier: Apache-2.0
// tetrakis reorder: the packets of a stream in the order that serves given cameras.
#include <memory>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/output/output_names.hpp"
#include "apps/tools/report/viewed_mesh.hpp"

namespace tetrakis::tools {
namespace {

struct ReorderArguments {
  StreamSource source;
  CameraChoice cameras;
  std::string output;
  bool force = false;
};

Status reorder(const ReorderArguments& arguments) {
  if (arguments.cameras.isDefault())
    return Status(TKS_USAGE, "nothing to serve: give --cameras or --view");
  Status stays = checkInputsStay({arguments.source.path}, arguments.output);
  if (!stays.ok()) return stays;
  Result<Output> output = Output::plan(arguments.output, arguments.force, ".tks");
  if (!output.ok()) return output.status();
  Result<OpenStream> stream = openTerrain(arguments.source);
  if (!stream.ok()) return stream.status();
  Decoder& decoder = stream->decoder;
  decoder.setThreads(hardwareThreads());
  const auto cameras = meshCameras(decoder, arguments.cameras);
  if (!cameras.ok()) return cameras.status();
  const Result<Buffer> reordered = decoder.reordered(*cameras);
  if (!reordered) return reordered.status();
  const auto bytes = std::as_bytes(reordered->bytes());
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
  verb.add_option("-o,--output", arguments->output, "Where to write; - is standard output")
      ->required()
      ->type_name("OUT.tks");
  addForce(verb, arguments->force);
  verb.callback([arguments, &line] { line.action = [arguments] { return reorder(*arguments); }; });
}

}  // namespace tetrakis::tools
