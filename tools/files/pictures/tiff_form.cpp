// SPDX-License-Identifier: Apache-2.0
// What TIFF tags tell of the samples that OpenImageIO does not.
#include <algorithm>
#include <filesystem>

#include "tools/files/pictures/band_colours.hpp"
#include "tools/files/pictures/tiff.hpp"

namespace tetrakis::tools {
namespace {

/// libtiff fills what lies outside with zeros, or leaves it as it was.
void noteBlocks(TIFF* tiff, uint64_t file_bytes, TiffForm& form) {
  const uint32_t count = TIFFIsTiled(tiff) ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
  uint32_t missing = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const uint64_t offset = TIFFGetStrileOffset(tiff, i), bytes = TIFFGetStrileByteCount(tiff, i);
    if (isMissing(tiff, i)) {
      ++missing;
    } else if (offset == 0 || bytes == 0 || bytes > file_bytes || offset > file_bytes - bytes) {
      form.whole = false;
    }
  }
  form.sparse = missing > 0;
  if (missing == count) form.whole = false;
}

bool hasAssociatedAlpha(TIFF* tiff) {
  uint16_t count = 0;
  const uint16_t* kinds = nullptr;
  if (!TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &count, &kinds)) return false;
  return std::find(kinds, kinds + count, EXTRASAMPLE_ASSOCALPHA) != kinds + count;
}

uint32_t kindOf(TIFF* tiff) {
  uint32_t kind = 0;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SUBFILETYPE, &kind);
  return kind;
}

/// Leaves the first directory.
void notePages(TIFF* tiff, TiffForm& form) {
  const auto [width, height] = sizeOfPage(tiff);
  while (TIFFReadDirectory(tiff)) {
    if (isMaskPage(tiff, width, height)) {
      form.mask = true;
    } else if (!(kindOf(tiff) & FILETYPE_REDUCEDIMAGE)) {
      form.further_pages = true;
    }
  }
}

}  // namespace

bool isMissing(TIFF* tiff, uint32_t strip_or_tile) {
  return TIFFGetStrileOffset(tiff, strip_or_tile) == 0 &&
         TIFFGetStrileByteCount(tiff, strip_or_tile) == 0;
}

std::pair<uint32_t, uint32_t> sizeOfPage(TIFF* tiff) {
  std::pair<uint32_t, uint32_t> size(0, 0);
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &size.first);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &size.second);
  return size;
}

bool isMaskPage(TIFF* tiff, uint32_t width, uint32_t height) {
  const uint32_t kind = kindOf(tiff);
  return (kind & FILETYPE_MASK) && !(kind & FILETYPE_REDUCEDIMAGE) &&
         sizeOfPage(tiff) == std::pair(width, height);
}

Result<TiffForm> tiffForm(const std::string& path) {
  const auto file = TiffFile::open(path, "r");
  if (!file.ok()) return file.status();
  TIFF* const tiff = file->get();
  std::error_code unknown_size;
  const uint64_t bytes = std::filesystem::file_size(path, unknown_size);
  uint16_t bits = 0;
  TiffForm form;
  form.states_bits = TIFFGetField(tiff, TIFFTAG_BITSPERSAMPLE, &bits) != 0;
  form.associated_alpha = hasAssociatedAlpha(tiff);
  form.colours = bandColours(tiff);
  form.nodata = tagText(tiff, kGdalNodataTag);
  noteBlocks(tiff, unknown_size ? UINT64_MAX : bytes, form);
  notePages(tiff, form);
  return form;
}

Status checkTiffSamples(const std::string& path, const std::string& name) {
  const auto file = TiffFile::open(path, "r");
  if (!file.ok()) return {};
  uint16_t format = SAMPLEFORMAT_UINT, bits = 1;
  TIFFGetFieldDefaulted(file->get(), TIFFTAG_SAMPLEFORMAT, &format);
  TIFFGetFieldDefaulted(file->get(), TIFFTAG_BITSPERSAMPLE, &bits);
  if (format == SAMPLEFORMAT_COMPLEXINT || format == SAMPLEFORMAT_COMPLEXIEEEFP)
    return {TKS_USAGE, name + " holds complex numbers: heights and textures are real ones"};
  // OpenImageIO knows even numbers of bits.
  if (format != SAMPLEFORMAT_IEEEFP && bits != 1 && (bits % 2 != 0 || (bits > 16 && bits < 32))) {
    return {TKS_USAGE, name + " has samples of " + std::to_string(bits) +
                           " bits: convert it (gdal_translate -co NBITS=" +
                           (bits < 8    ? "8)"
                            : bits < 16 ? "16)"
                                        : "32)")};
  }
  if (format != SAMPLEFORMAT_IEEEFP && bits == 64) {
    return {TKS_USAGE, name +
                           " holds integers of 64 bits: convert it to 32 bits (gdal_translate "
                           "-ot Int32)"};
  }
  return {};
}

}  // namespace tetrakis::tools
