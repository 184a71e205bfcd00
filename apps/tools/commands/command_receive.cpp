// SPDX-License-Identifier: Apache-2.0
// tetrakis receive: what a receiver gets of a sequence that tetrakis serve hands out, as a file.
#include <fstream>
#include <memory>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/files/positive.hpp"
#include "apps/tools/output/output.hpp"
#include "apps/tools/report/viewed_mesh.hpp"
#include "apps/tools/serve/received_sequence.hpp"

namespace tetrakis::tools {
namespace {

struct ReceiveArguments {
  ReceiveOptions options;
  CameraChoice cameras;
  std::string output, channel;
  double seconds = 0;
  bool force = false;
};

/// A control message tells of one camera.
Result<tks_screen_camera> cameraOver(Decoder& decoder, const CameraChoice& choice) {
  Result<std::vector<tks_screen_camera>> cameras = meshCameras(decoder, choice);
  if (!cameras.ok()) return cameras.status();
  if (cameras->size() == 1) return cameras->front();
  return Status(TKS_USAGE,
                "a receiver looks with one camera, not with " + std::to_string(cameras->size()));
}

Result<ReceiveOptions> optionsOf(const ReceiveArguments& arguments) {
  ReceiveOptions options = arguments.options;
  if (arguments.seconds > 0) options.seconds = arguments.seconds;
  if (options.seconds && !options.live) return Status(TKS_USAGE, "--seconds takes --live");
  if (!arguments.cameras.isDefault())
    options.look = [&](Decoder& decoder) { return cameraOver(decoder, arguments.cameras); };
  if (arguments.channel.empty()) return options;
  const Result<double> rate = parseRate(arguments.channel, "bit");
  if (!rate.ok()) return Status(TKS_USAGE, "--channel: " + rate.status().message());
  options.has_link = true;
  options.link =
      static_cast<uint32_t>(std::clamp(*rate / 8, 1., static_cast<double>(options.link)));
  return options;
}

/// Writes behind one another what comes.
Result<Reception> receiveInto(const std::string& path, const ReceiveOptions& options) {
  std::ofstream file(path, std::ios::binary);
  return receiveSequence(options, [&](std::span<const uint8_t> bytes) {
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    return file.flush() ? Status() : Status(TKS_IO, "cannot write " + quoted(path));
  });
}

Status receive(const ReceiveArguments& arguments, bool quiet) {
  const Result<ReceiveOptions> options = optionsOf(arguments);
  if (!options.ok()) return options.status();
  Result<Output> output = Output::plan(arguments.output, arguments.force, ".tks");
  if (!output.ok()) return output.status();
  Reception reception;
  const Status written = output->stage([&](const std::string& path) {
    const Result<Reception> received = receiveInto(path, *options);
    if (received.ok()) reception = *received;
    return received.status();
  });
  if (!written.ok()) return written;
  if (Status status = output->commit(); !status.ok()) return status;
  tellNote(reception.ended, quiet);
  if (!quiet)
    tellLine(arguments.output + ": " + std::to_string(reception.bytes) + " bytes of groups, for " +
             std::to_string(reception.messages) + " control messages of " +
             std::to_string(reception.control_bytes) + " bytes");
  return Status();
}

}  // namespace

void addReceive(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<ReceiveArguments>();
  ReceiveOptions& options = arguments->options;
  CLI::App& verb =
      *app.add_subcommand("receive", "Write what a receiver gets of a served sequence");
  verb.add_option("URL", options.url, "What tetrakis serve prints")->required()->type_name("");
  verb.add_option("-o,--output", arguments->output, "Where to write; - is standard output")
      ->required()
      ->type_name("OUT.tks");
  verb.add_option("--channel", arguments->channel,
                  "Bits a second of the link: 256k/s; frames pass as if no more came")
      ->type_name("RATE");
  addTriangles(verb, options.triangles, "The receiver draws meshes of so many triangles");
  addCameraOptions(verb, arguments->cameras);
  CLI::Option* const live =
      verb.add_flag("--live", options.live, "Follow the newest frame, for --seconds");
  verb.add_option("--seconds", arguments->seconds, "How long to follow it")
      ->check(positive())
      ->type_name("S");
  live->needs(verb.get_option("--seconds"));
  addForce(verb, arguments->force);
  verb.callback([arguments, &line] {
    line.action = [arguments, &line] { return receive(*arguments, line.quiet); };
  });
}

}  // namespace tetrakis::tools
