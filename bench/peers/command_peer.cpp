// SPDX-License-Identifier: Apache-2.0
// Codecs run as programs on temporary files; see command_peer.hpp.
#include "bench/peers/command_peer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <span>

#include "apps/tools/files/files.hpp"
#include "bench/peers/program.hpp"

namespace tetrakis::bench {
namespace {

namespace fs = std::filesystem;

// Samples of more than 8 bits go into 16 as they are: scaling would cost a lossless codec bits.
tools::ImageFile imageOf(const Raster& raster) {
  const bool wide = raster.bits > 8;
  tools::ImageFile file{raster.width, raster.height, raster.channels, wide ? TKS_U16 : TKS_U8, {}};
  if (wide) {
    const auto bytes = std::as_bytes(std::span(raster.samples));
    file.data.assign(bytes.begin(), bytes.end());
  } else {
    for (const uint16_t sample : raster.samples)
      file.data.push_back(static_cast<std::byte>(sample));
  }
  return file;
}

// The samples of a decoded file, which must have the raster's shape and depth.
Result<std::vector<uint16_t>> samplesOf(const std::string& path, const Raster& raster) {
  const Result<tools::ImageFile> file = tools::readImage(path);
  if (!file.ok()) return file.status();
  const bool wide = raster.bits > 8;
  if (file->width != raster.width || file->height != raster.height ||
      file->channels != raster.channels || file->sample != (wide ? TKS_U16 : TKS_U8)) {
    return Status(TKS_MISMATCH, "The decoded image has another shape or depth than the original.");
  }
  std::vector<uint16_t> samples(raster.samples.size());
  if (wide) {
    std::memcpy(samples.data(), file->data.data(), file->data.size());
  } else {
    std::transform(file->data.begin(), file->data.end(), samples.begin(),
                   [](std::byte b) { return std::to_integer<uint16_t>(b); });
  }
  return samples;
}

struct CodedFile {
  uint64_t bytes = 0;
  std::vector<uint16_t> samples;  // decoded
};

}  // namespace

// The files of one raster, and what a quality makes of them.
class CommandPeer::Session {
 public:
  Session(const CommandPeer& peer, const Raster& raster) : peer_(peer), raster_(raster) {}

  Status writeOriginal() const {
    if (!folder_.made()) return {TKS_IO, "Cannot make a temporary folder: is the disk full?"};
    return tools::writeImage(folder_.file("in.png"), imageOf(raster_));
  }

  Result<CodedFile> code(const std::string& quality) const {
    const std::string coded = folder_.file("coded" + peer_.tools_.extension);
    const std::string out = folder_.file("out.png");
    std::vector<std::string> encoder = {peer_.tools_.encoder};
    append(encoder, peer_.encoderOptions(raster_, quality));
    append(encoder, {folder_.file("in.png"), coded});
    std::vector<std::string> decoder = {peer_.tools_.decoder};
    append(decoder, peer_.tools_.decoder_options);
    append(decoder, {coded, out});
    Status status = runProgram(encoder, folder_.file("log"));
    if (status.ok()) status = runProgram(decoder, folder_.file("log"));
    if (!status.ok()) return status;
    auto samples = samplesOf(out, raster_);
    if (!samples.ok()) return samples.status();
    return CodedFile{fs::file_size(coded), std::move(*samples)};
  }

 private:
  static void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
  }

  const CommandPeer& peer_;
  const Raster& raster_;
  TemporaryFolder folder_;
};

Result<PeerCurves> CommandPeer::curves(const Raster& raster,
                                       const std::vector<uint64_t>& targets) const {
  const Session session(*this, raster);
  const Status written = session.writeOriginal();
  if (!written.ok()) return written;
  PeerCurves curves;
  if (!qualities_.lossy.empty()) curves.settings.emplace_back();
  for (const std::string& quality : qualities_.lossy) {
    const Result<CodedFile> file = session.code(quality);
    if (!file.ok()) return file.status();
    curves.settings.front().push_back({file->bytes, meanSquaredError(raster, file->samples)});
    if (file->bytes > targets.back()) break;
  }
  if (qualities_.lossless.empty()) return curves;
  const Result<CodedFile> lossless = session.code(qualities_.lossless);
  if (!lossless.ok()) return lossless.status();
  if (lossless->samples != raster.samples) {
    return Status(TKS_MISMATCH, tools_.encoder + "'s lossless file does not restore the samples.");
  }
  curves.lossless_bytes = lossless->bytes;
  return curves;
}

Status CommandPeer::installed() const {
  for (const std::string& program : {tools_.encoder, tools_.decoder}) {
    const Status status = runProgram({program, "--version"}, "/dev/null");
    if (!status.ok()) {
      return {TKS_UNSUPPORTED, status.message() + "; Debian's " + tools_.package + " has it"};
    }
  }
  return {};
}

void addInstalled(std::unique_ptr<CommandPeer> peer, std::vector<std::unique_ptr<Peer>>& peers) {
  const Status status = peer->installed();
  if (status.ok()) {
    peers.push_back(std::move(peer));
  } else {
    std::fprintf(stderr, "%s is left out: %s.\n", peer->name().c_str(), status.message().c_str());
  }
}

}  // namespace tetrakis::bench
