// SPDX-License-Identifier: Apache-2.0
// openStreamWindows() reads windows of a stream, so that streams that were coded apart become one
// plane.
#include <algorithm>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/stream.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/mosaic/height_source.hpp"

namespace tetrakis::tools {

namespace {

class StreamWindows : public HeightSource {
 public:
  StreamWindows(std::string path, OpenStream stream, HeightFile described)
      : path_(std::move(path)), stream_(std::move(stream)), described_(std::move(described)) {}

  const HeightFile& described() const override { return described_; }
  Status read(const tks_window& window, std::byte* samples) override {
    const Result<std::vector<std::byte>> decoded = stream_.decoder.heights(window);
    if (!decoded.ok()) return decoded.status();
    std::copy(decoded->begin(), decoded->end(), samples);
    return {};
  }
  std::vector<std::string> filesOf(const tks_window&) const override { return {path_}; }

 private:
  std::string path_;
  OpenStream stream_;
  HeightFile described_;
};

/// What of a stream is no height of the plane.
void noteOthers(const OpenStream& stream, Notes& notes) {
  const tks_info& info = stream.decoder.info();
  if (info.has_texture) notes.push_back({"the texture is left out", ""});
  if (info.frames > 1 || (stream.sequence && stream.sequence->frames > 1))
    notes.push_back({"of the frames the first one is read", ""});
  if (info.available_bytes < info.stream_bytes)
    notes.push_back({"the stream ends early: its heights are what is there", ""});
}

}  // namespace

Result<OpenSource> openStreamWindows(const std::string& path, Notes& notes) {
  Result<OpenStream> stream = openTerrain({path, std::nullopt, false});
  if (!stream.ok()) return stream.status();
  const tks_info info = stream->decoder.info();
  if (info.has_heights == 0) return Status(TKS_USAGE, quoted(path) + " holds no heights");
  if (info.domain == TKS_DOMAIN_FOREST)
    return Status(TKS_USAGE, quoted(path) + " lies on patches, not on a plane");
  // A sample is enough for all that the stream says of its heights.
  Result<HeightFile> described = decodeHeights(stream->decoder, tks_window{0, 0, 1, 1});
  if (!described.ok()) return described.status();
  noteOthers(*stream, notes);
  described->width = info.width;
  described->height = info.height;
  described->data.clear();
  return OpenSource(
      std::make_unique<StreamWindows>(path, *std::move(stream), *std::move(described)));
}

}  // namespace tetrakis::tools
