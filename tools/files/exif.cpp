// SPDX-License-Identifier: Apache-2.0
// The orientation in EXIF data that OpenImageIO does not look for.
#include "tools/files/exif.hpp"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/tiffutils.h>

#include <algorithm>

namespace tetrakis::tools {

int exifOrientation(std::span<const std::byte> exif) {
  OIIO::ImageSpec spec;
  const OIIO::string_view text(reinterpret_cast<const char*>(exif.data()), exif.size());
  if (exif.empty() || !OIIO::decode_exif(text, spec)) return 1;
  const int tag = spec.get_int_attribute("Orientation", 1);
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
