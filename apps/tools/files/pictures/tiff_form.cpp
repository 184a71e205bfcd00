// SPDX-License-Identifier: Apache-2.0
// What TIFF tags tell of the samples.
#include <algorithm>
#include <filesystem>

#include "apps/tools/files/pictures/band_colours.hpp"
#include "apps/tools/files/pictures/tiff.hpp"

namespace tetrakis::tools {
namespace {

/// The most bytes that one coded byte stands for; 0: there is no such bound.
uint64_t largestRatio(uint16_t compression) {
  switch (compression) {
    case COMPRESSION_NONE:
      return 1;
    case COMPRESSION_PACKBITS:
      return 64;
    case COMPRESSION_LZW:            // 4096 words, the longest of as many bytes, in 12 bits
    case COMPRESSION_ADOBE_DEFLATE:  // 1032
    case COMPRESSION_DEFLATE:
      return 2731;
    default:
      return 0;
  }
}

/// Decoded, of a strip or tile; the last strips of planes have fewer rows than the others.
uint64_t bytesOfBlock(TIFF* tiff, uint32_t block) {
  if (TIFFIsTiled(tiff)) return TIFFTileSize64(tiff);
  uint32_t rows = 0, height = 0;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &rows);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
  rows = std::clamp(rows, uint32_t{1}, std::max(height, uint32_t{1}));
  const uint32_t strips_of_plane = (height + rows - 1) / rows;
  const uint32_t above = block % std::max(strips_of_plane, uint32_t{1}) * rows;
  return TIFFVStripSize64(tiff, std::min(rows, height - above));
}

/// libtiff fills what lies outside with zeros, or leaves it as it was. Blocks that are too short
/// for what they are to hold are known before there is memory for it.
void noteBlocks(TIFF* tiff, uint64_t file_bytes, TiffForm& form) {
  const uint32_t count = TIFFIsTiled(tiff) ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
  const uint64_t ratio = largestRatio(shortTag(tiff, TIFFTAG_COMPRESSION));
  uint32_t missing = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const uint64_t offset = TIFFGetStrileOffset(tiff, i), bytes = TIFFGetStrileByteCount(tiff, i);
    if (isMissing(tiff, i)) {
      ++missing;
    } else if (offset == 0 || bytes == 0 || bytes > file_bytes || offset > file_bytes - bytes ||
               (ratio != 0 && bytesOfBlock(tiff, i) / ratio > bytes)) {
      form.whole = false;
    }
  }
  form.sparse = missing > 0;
  form.empty = missing == count;
}

bool hasAssociatedAlpha(TIFF* tiff) {
  uint16_t count = 0;
  const uint16_t* kinds = nullptr;
  if (!TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &count, &kinds)) return false;
  return std::find(kinds, kinds + count, EXTRASAMPLE_ASSOCALPHA) != kinds + count;
}

/// 16 bits each, of which some writers fill the lower 8 alone.
std::vector<std::array<uint8_t, 3>> colourMap(TIFF* tiff, int bits) {
  constexpr int kMostBits = 16;
  std::array<uint16_t*, 3> channels{};
  if (bits > kMostBits ||
      !TIFFGetField(tiff, TIFFTAG_COLORMAP, &channels[0], &channels[1], &channels[2]))
    return {};
  const size_t places = size_t{1} << bits;
  uint16_t largest = 0;
  for (const uint16_t* channel : channels)
    largest = std::max(largest, *std::max_element(channel, channel + places));
  const int shift = largest > UINT8_MAX ? 8 : 0;
  std::vector<std::array<uint8_t, 3>> map(places);
  for (size_t i = 0; i < places; ++i)
    for (size_t c = 0; c < 3; ++c) map[i][c] = static_cast<uint8_t>(channels[c][i] >> shift);
  return map;
}

void noteColours(TIFF* tiff, TiffForm& form) {
  constexpr uint16_t kInks = 4;
  const uint16_t photometric = photometricOf(tiff);
  form.bits = shortTag(tiff, TIFFTAG_BITSPERSAMPLE);
  form.white_is_zero = photometric == PHOTOMETRIC_MINISWHITE;
  form.palette = photometric == PHOTOMETRIC_PALETTE;
  form.inks = photometric == PHOTOMETRIC_SEPARATED &&
              shortTag(tiff, TIFFTAG_INKSET) == INKSET_CMYK &&
              shortTag(tiff, TIFFTAG_SAMPLESPERPIXEL) >= kInks;
  if (form.palette) form.map = colourMap(tiff, form.bits);
  form.colours = bandColours(tiff);
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
  TiffForm form;
  noteColours(tiff, form);
  form.associated_alpha = hasAssociatedAlpha(tiff);
  form.nodata = tagText(tiff, kGdalNodataTag);
  noteBlocks(tiff, unknown_size ? UINT64_MAX : bytes, form);
  notePages(tiff, form);
  return form;
}

}  // namespace tetrakis::tools
