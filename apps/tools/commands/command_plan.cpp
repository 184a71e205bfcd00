// SPDX-License-Identifier: Apache-2.0
// tetrakis plan: how much of a stream a receiver should get, and what it will see.
#include <cmath>
#include <memory>
#include <utility>

#include "apps/tools/commands/command.hpp"
#include "apps/tools/commands/notes.hpp"
#include "apps/tools/commands/options.hpp"
#include "apps/tools/commands/receiver_plan.hpp"
#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/positive.hpp"
#include "apps/tools/output/json.hpp"
#include "apps/tools/report/comparison.hpp"

namespace tetrakis::tools {
namespace {

struct PlanArguments {
  StreamSource source;
  std::string channel, renderer;
  double seconds = 0, fps = 30;
  CameraChoice cameras;
  bool json = false;
};

Result<Receiver> receiverOf(const PlanArguments& arguments) {
  Receiver receiver;
  receiver.fps = arguments.fps;
  if (arguments.seconds > 0) receiver.seconds = arguments.seconds;
  if (!arguments.channel.empty()) {
    const Result<double> rate = parseRate(arguments.channel, "bit");
    if (!rate.ok()) return Status(TKS_USAGE, "--channel: " + rate.status().message());
    receiver.channel = *rate;
  }
  if (!arguments.renderer.empty()) {
    const Result<double> rate = parseRate(arguments.renderer, "tri");
    if (!rate.ok()) return Status(TKS_USAGE, "--renderer: " + rate.status().message());
    receiver.renderer = *rate;
  }
  return receiver;
}

/// What the receiver will see beside the whole stream; nothing on a machine that cannot draw.
Result<std::optional<double>> expectedPsnr(OpenStream& stream, const ReceiverPlan& plan,
                                           const CameraChoice& cameras, bool quiet) {
  Reference whole;
  const tks_info& info = stream.decoder.info();
  if (isGridOnCube(info)) {
    if (!cameras.isDefault())
      return Status(TKS_USAGE, "a mesh of heights on a cube is a globe, which no camera looks at");
    tellNote("no screen figures: the heights lie on a cube", quiet);
    return std::optional<double>();
  }
  if (info.has_heights) {
    Result<HeightFile> heights = decodeHeights(stream.decoder);
    if (!heights.ok()) return heights.status();
    whole.heights = std::move(*heights);
  }
  if (info.has_texture) {
    Result<ImageFile> image = decodeImage(stream.decoder);
    if (!image.ok()) return image.status();
    whole.image = std::move(*image);
  }
  Result<Comparer> comparer = Comparer::create(whole, info);
  if (!comparer.ok()) return comparer.status();
  if (Status status = comparer->look(cameras); !status.ok()) {
    if (status.code() != TKS_UNSUPPORTED || !cameras.isDefault()) return status;
    tellNote("no screen figures: " + status.message(), quiet);
    return std::optional<double>();
  }
  const Result<Measurement> seen =
      comparer->measure(octets(stream.bytes).first(plan.bytes), plan.triangles.value_or(0));
  if (!seen.ok()) return seen.status();
  return seen->screen_psnr;
}

Json planJson(const ReceiverPlan& plan, std::optional<double> psnr) {
  const auto known = [](std::optional<double> value) { return value ? Json(*value) : Json(); };
  return {{"bytes", plan.bytes},
          {"triangles", plan.triangles ? Json(*plan.triangles) : Json()},
          {"limit", plan.limit},
          {"channel", known(plan.receiver.channel)},
          {"renderer", known(plan.receiver.renderer)},
          {"seconds", known(plan.receiver.seconds)},
          {"fps", plan.receiver.fps},
          {"screen_psnr", psnr ? finiteOrNull(*psnr) : Json()},
          {"screen_exact", psnr ? Json(std::isinf(*psnr)) : Json()}};
}

Status plan(const PlanArguments& arguments, bool quiet) {
  const Result<Receiver> receiver = receiverOf(arguments);
  if (!receiver.ok()) return receiver.status();
  Result<OpenStream> stream = openTerrain(arguments.source);
  if (!stream.ok()) return stream.status();
  stream->decoder.setThreads(hardwareThreads());
  const Result<ReceiverPlan> plan = planFor(octets(stream->bytes), *receiver);
  if (!plan.ok()) return plan.status();
  const auto psnr = expectedPsnr(*stream, *plan, arguments.cameras, quiet);
  if (!psnr.ok()) return psnr.status();
  const Json json = planJson(*plan, *psnr);
  return print(arguments.json ? dump(json) : table(legible(json)));
}

}  // namespace

void addPlan(CLI::App& app, CommandLine& line) {
  const auto arguments = std::make_shared<PlanArguments>();
  CLI::App& verb = *app.add_subcommand("plan", "Say how much of a stream serves a receiver");
  addSource(verb, arguments->source);
  verb.add_option("--channel", arguments->channel, "Bits a second: 256k/s")->type_name("RATE");
  verb.add_option("--renderer", arguments->renderer, "Triangles a second: 200k/s")
      ->type_name("RATE");
  verb.add_option("--seconds", arguments->seconds, "How long the bytes may take")
      ->check(positive())
      ->type_name("S");
  verb.add_option("--fps", arguments->fps, "Frames drawn in a second (30)")
      ->check(positive())
      ->type_name("N");
  addCameraOptions(verb, arguments->cameras);
  verb.add_flag("--json", arguments->json, "JSON instead of a table");
  verb.callback([arguments, &line] {
    line.action = [arguments, &line] { return plan(*arguments, line.quiet); };
  });
}

}  // namespace tetrakis::tools
