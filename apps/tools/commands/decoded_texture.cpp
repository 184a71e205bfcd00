// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/commands/decoded_texture.hpp"

#include <system_error>

#include "apps/tools/commands/decode_windows.hpp"

namespace tetrakis::tools {

uint64_t DecodedTexture::begin(DecodeMemory& memory) {
  const tks_info& info = stream_.decoder.info();
  const bool wants_heights = !arguments_.height.empty() || !arguments_.mesh.empty();
  if (stream_.groups || arguments_.threads < 2 || !wantsTexture(arguments_) || !wants_heights ||
      !info.has_texture)
    return 0;
  const std::optional<uint64_t> bytes = memory.textureBeside();
  if (!bytes) return 0;
  const auto decode = [&stream = stream_, &arguments = arguments_,
                       window = textureWindow(arguments_, info),
                       copies = memory.texture()]() -> Result<ImageFile> {
    Result<Decoder> decoder = openAgain(stream);
    if (!decoder) return decoder.status();
    decoder->setThreads(arguments.threads);
    if (const Status set = decoder->setLevels(0, arguments.level); !set.ok()) return set;
    return decodeImage(*decoder, window, copies);
  };
  try {
    beside_ = std::async(std::launch::async, decode);
  } catch (const std::system_error&) {
    beside_ = std::async(std::launch::deferred, decode);  // the system has no thread to give
  }
  return *bytes;
}

const Result<ImageFile>& DecodedTexture::get(const DecodeMemory& memory) {
  if (!image_) {
    Decoder& decoder = stream_.decoder;
    image_ = beside_.valid() ? beside_.get()
                             : decodeImage(decoder, textureWindow(arguments_, decoder.info()),
                                           memory.texture());
  }
  return *image_;
}

}  // namespace tetrakis::tools
