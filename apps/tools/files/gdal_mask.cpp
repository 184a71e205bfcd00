// SPDX-License-Identifier: Apache-2.0
// Masks (GDAL RFC 15; TIFF 6.0, NewSubfileType and transparency masks).
#include "apps/tools/files/gdal_mask.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/pictures/tiff.hpp"

namespace tetrakis::tools {
namespace {

using Mask = std::vector<uint8_t>;

/// Where a row or a tile of the page goes.
struct Block {
  uint32_t x, y, width, height;
  size_t row_bytes;
};

/// One band of a page.
struct MaskBand {
  TIFF* tiff;
  int bits;
  uint16_t plane, first, stride;  ///< which plane, and which samples of its rows
  uint32_t width, height;

  /// Takes the samples of a block that lie inside the picture.
  void unpack(const std::vector<uint8_t>& packed, const Block& block, Mask& mask) const {
    for (uint32_t y = 0; y < block.height; ++y) {
      const uint8_t* const row = packed.data() + y * block.row_bytes;
      uint8_t* const to = mask.data() + size_t{block.y + y} * width + block.x;
      for (uint32_t x = 0; x < block.width; ++x) {
        const size_t at = size_t{x} * stride + first;
        to[x] = bits == 8 ? row[at] : static_cast<uint8_t>(row[at / 8] >> (7 - at % 8) & 1);
      }
    }
  }

  bool readTiles(Mask& mask) const {
    uint32_t side_x = 0, side_y = 0;
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &side_x);
    TIFFGetField(tiff, TIFFTAG_TILELENGTH, &side_y);
    std::vector<uint8_t> packed(static_cast<size_t>(TIFFTileSize(tiff)));
    const auto row_bytes = static_cast<size_t>(TIFFTileRowSize(tiff));
    if (side_x == 0 || side_y == 0 || packed.size() < row_bytes * side_y) return false;
    for (uint32_t y = 0; y < height; y += side_y) {
      for (uint32_t x = 0; x < width; x += side_x) {
        if (TIFFReadTile(tiff, packed.data(), x, y, 0, plane) < 0) return false;
        unpack(packed, {x, y, std::min(side_x, width - x), std::min(side_y, height - y), row_bytes},
               mask);
      }
    }
    return true;
  }

  bool readRows(Mask& mask) const {
    std::vector<uint8_t> packed(static_cast<size_t>(TIFFScanlineSize(tiff)));
    for (uint32_t y = 0; y < height; ++y) {
      if (TIFFReadScanline(tiff, packed.data(), y, plane) < 0) return false;
      unpack(packed, {0, y, width, 1, packed.size()}, mask);
    }
    return true;
  }
};

/// GDAL lets a band without flags have no mask, where another has some.
bool hasFlags(const std::string& metadata, uint16_t band) {
  const std::string key = "INTERNAL_MASK_FLAGS_";
  return metadata.find(key) == metadata.npos ||
         metadata.find(key + std::to_string(band) + '"') != metadata.npos;
}

/// Of the current directory, whose size is known.
Result<GdalMask> readCurrent(const TiffFile& file, const std::string& path, uint32_t width,
                             uint32_t height) {
  TIFF* const tiff = file.get();
  const int bits = shortTag(tiff, TIFFTAG_BITSPERSAMPLE);
  const uint16_t bands = shortTag(tiff, TIFFTAG_SAMPLESPERPIXEL);
  if (bits != 1 && bits != 8)
    return Status(TKS_USAGE, "the mask of " + quoted(path) + " has neither 1 nor 8 bits");
  const bool apart = shortTag(tiff, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
  const std::string metadata = tagText(tiff, kGdalMetadataTag);
  GdalMask all;
  for (uint16_t band = 0; band < bands; ++band) {
    Mask shown(size_t{width} * height, 255);
    const MaskBand one{tiff,
                       bits,
                       apart ? band : uint16_t{0},
                       apart ? uint16_t{0} : band,
                       apart ? uint16_t{1} : bands,
                       width,
                       height};
    const bool flags = bands == 1 || hasFlags(metadata, band + 1);
    if (flags && !(TIFFIsTiled(tiff) ? one.readTiles(shown) : one.readRows(shown)))
      return file.failure();
    if (band == 0) {
      all.shown = std::move(shown);
      continue;
    }
    for (size_t i = 0; i < shown.size(); ++i) {
      all.differs = all.differs || (shown[i] != 0) != (all.shown[i] != 0);
      all.shown[i] |= shown[i];
    }
  }
  return all;
}

}  // namespace

Result<GdalMask> readMaskPage(const std::string& path, uint32_t width, uint32_t height) {
  const auto file = TiffFile::open(path, "r");
  if (!file.ok()) return file.status();
  while (TIFFReadDirectory(file->get())) {
    if (isMaskPage(file->get(), width, height)) return readCurrent(*file, path, width, height);
  }
  return GdalMask();
}

Result<GdalMask> readMaskBeside(const std::string& path, uint32_t width, uint32_t height) {
  const std::string name = path + ".msk";
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(name, ignored)) return GdalMask();
  const auto file = TiffFile::open(name, "r");
  if (!file.ok()) return file.status();
  if (sizeOfPage(file->get()) != std::pair(width, height)) {
    return Status(TKS_USAGE, quoted(name) + " is a mask of another size than " + quoted(path));
  }
  return readCurrent(*file, name, width, height);
}

Result<std::vector<uint8_t>> maskOfMissing(const std::string& path, uint32_t width,
                                           uint32_t height) {
  const auto file = TiffFile::open(path, "r");
  if (!file.ok()) return file.status();
  TIFF* const tiff = file->get();
  const bool tiled = TIFFIsTiled(tiff);
  uint32_t side_x = width, side_y = height;
  if (tiled) {
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &side_x);
    TIFFGetField(tiff, TIFFTAG_TILELENGTH, &side_y);
  } else {
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &side_y);
  }
  if (side_x == 0 || side_y == 0) return file->failure();
  Mask mask(size_t{width} * height, 255);
  for (uint32_t y = 0; y < height; y += std::min(side_y, height - y)) {
    for (uint32_t x = 0; x < width; x += std::min(side_x, width - x)) {
      if (!isMissing(tiff,
                     tiled ? TIFFComputeTile(tiff, x, y, 0, 0) : TIFFComputeStrip(tiff, y, 0)))
        continue;
      for (uint32_t row = y; row < y + std::min(side_y, height - y); ++row)
        std::fill_n(&mask[size_t{row} * width + x], std::min(side_x, width - x), uint8_t{0});
    }
  }
  return mask;
}

}  // namespace tetrakis::tools
