// SPDX-License-Identifier: Apache-2.0
// The orientation in EXIF data that OpenImageIO does not look for.
#include "apps/tools/files/pictures/exif.hpp"

#include <algorithm>

#include "apps/tools/files/pictures/picture_formats.hpp"

namespace tetrakis::tools {

int exifOrientation(std::span<const std::byte> exif) {
  if (exif.empty()) return 1;
  const auto formats = pictureFormats();
  const int tag = formats.ok() ? (*formats)->orientation(exif) : 1;
  return tag >= 1 && tag <= 8 ? tag : 1;
}

std::span<const std::byte> webpChunk(std::span<const std::byte> file, std::string_view name) {
  constexpr size_t kRiffHead = 12, kChunkHead = 8;
  for (size_t at = kRiffHead; at + kChunkHead <= file.size();) {
    size_t bytes = 0;
    for (size_t i = 0; i < 4; ++i) bytes |= std::to_integer<size_t>(file[at + 4 + i]) << (8 * i);
    const auto content = file.subspan(at + kChunkHead);
    const std::string_view id(reinterpret_cast<const char*>(&file[at]), 4);
    if (id == name) return content.first(std::min(bytes, content.size()));
    at += kChunkHead + bytes + bytes % 2;
  }
  return {};
}

}  // namespace tetrakis::tools
