// SPDX-License-Identifier: Apache-2.0
// What TIFF tags tell of the samples that OpenImageIO does not.
#include <filesystem>

#include "tools/tiff.hpp"

namespace tetrakis::tools {
namespace {

/// libtiff fills what is missing with zeros, or leaves it as it was.
bool holdsAllStrips(TIFF* tiff, uint64_t file_bytes) {
  const uint32_t count = TIFFIsTiled(tiff) ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
  for (uint32_t i = 0; i < count; ++i) {
    const uint64_t offset = TIFFGetStrileOffset(tiff, i), bytes = TIFFGetStrileByteCount(tiff, i);
    if (offset == 0 || bytes == 0 || bytes > file_bytes || offset > file_bytes - bytes)
      return false;
  }
  return true;
}

}  // namespace

Result<TiffForm> tiffForm(const std::string& path) {
  const auto file = TiffFile::open(path, "r");
  if (!file.ok()) return file.status();
  TIFF* const tiff = file->get();
  std::error_code unknown_size;
  const uint64_t bytes = std::filesystem::file_size(path, unknown_size);
  uint16_t bits = 1;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  return TiffForm{bits, unknown_size || holdsAllStrips(tiff, bytes)};
}

}  // namespace tetrakis::tools
