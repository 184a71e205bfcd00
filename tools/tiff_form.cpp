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

bool associatedAlpha(TIFF* tiff) {
  uint16_t count = 0;
  const uint16_t* kinds = nullptr;
  return TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &count, &kinds) && count > 0 &&
         kinds[0] == EXTRASAMPLE_ASSOCALPHA;
}

/// Leaves the first directory.
bool hasFurtherPages(TIFF* tiff) {
  while (TIFFReadDirectory(tiff)) {
    uint32_t kind = 0;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SUBFILETYPE, &kind);
    if (!(kind & FILETYPE_REDUCEDIMAGE)) return true;
  }
  return false;
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
  TiffForm form{bits, unknown_size || holdsAllStrips(tiff, bytes), associatedAlpha(tiff)};
  form.further_pages = hasFurtherPages(tiff);
  return form;
}

}  // namespace tetrakis::tools
