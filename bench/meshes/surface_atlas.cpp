// SPDX-License-Identifier: Apache-2.0
#include "bench/meshes/surface_atlas.hpp"

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>

#include "apps/tools/files/stream.hpp"
#include "bench/peers/program.hpp"
#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {

Result<ErrorCurve> tetrakisAtlas(const SurfaceModel& model, const tools::ImageFile& atlas) {
  constexpr double kFewest = 1000, kMost = 512 << 10;
  const double ratio = std::sqrt(2.0);
  const tks_image image = tools::asImage(atlas);
  tks_encode_options options = makeEncodeOptions();
  options.bytes = static_cast<uint64_t>(kMost);
  const Result<Buffer> stream = encode(nullptr, &image, options);
  if (!stream.ok()) return stream.status();
  ErrorCurve curve;
  for (double bytes = kFewest; bytes < kMost * ratio; bytes *= ratio) {
    const auto prefix =
        stream->bytes().first(std::min(stream->bytes().size(), static_cast<size_t>(bytes)));
    Result<Decoder> decoder = Decoder::open(prefix);
    if (!decoder.ok()) return decoder.status();
    const Result<tools::ImageFile> texels = tools::decodeImage(*decoder);
    if (!texels.ok()) return texels.status();
    curve.push_back({std::sqrt(tools::colourError(model.painted, *texels)),
                     static_cast<double>(prefix.size())});
    if (prefix.size() == stream->bytes().size()) break;
  }
  return curve;
}

Result<ErrorCurve> avifAtlas(const SurfaceModel& model, const tools::ImageFile& atlas) {
  const TemporaryFolder folder;
  if (!folder.made()) return Status(TKS_IO, "Cannot make a temporary folder: is the disk full?");
  const std::string in = folder.file("in.png"), coded = folder.file("coded.avif");
  const std::string out = folder.file("out.png"), log = folder.file("log");
  Status status = tools::writeImage(in, atlas);
  ErrorCurve curve;
  for (const char* quantiser : {"63", "57", "51", "45", "39", "33", "27", "20"}) {
    if (status.ok())
      status = runProgram({"avifenc", "-c", "aom", "-j", "1", "-s", "6", "-d", "8", "-y", "444",
                           "-a", "tune=psnr", "--min", quantiser, "--max", quantiser, in, coded},
                          log);
    if (status.ok()) status = runProgram({"avifdec", "-j", "1", coded, out}, log);
    if (!status.ok()) return status;
    const Result<tools::ImageFile> texels = tools::readImage(out);
    if (!texels.ok()) return texels.status();
    curve.push_back({std::sqrt(tools::colourError(model.painted, *texels)),
                     static_cast<double>(std::filesystem::file_size(coded))});
  }
  return curve;
}

}  // namespace tetrakis::bench
