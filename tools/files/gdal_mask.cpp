// SPDX-License-Identifier: Apache-2.0
// Masks (GDAL RFC 15; TIFF 6.0, NewSubfileType and transparency masks).
#include "tools/files/gdal_mask.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "tools/files/file_bytes.hpp"
#include "tools/files/pictures/tiff.hpp"

namespace tetrakis::tools {
namespace {

using Mask = std::vector<uint8_t>;

/// Where a row or a tile of the page goes.
struct Block {
  uint32_t x, y, width, height;
  size_t row_bytes;
};

/// Takes the samples of a block that lie inside the picture.
void unpack(const std::vector<uint8_t>& packed, const Block& block, int bits, uint32_t width,
            Mask& mask) {
  for (uint32_t y = 0; y < block.height; ++y) {
    const uint8_t* const row = packed.data() + y * block.row_bytes;
    uint8_t* const to = mask.data() + size_t{block.y + y} * width + block.x;
    for (uint32_t x = 0; x < block.width; ++x) {
      to[x] = bits == 8 ? row[x] : static_cast<uint8_t>(row[x / 8] >> (7 - x % 8) & 1);
    }
  }
}

bool readTiles(TIFF* tiff, int bits, uint32_t width, uint32_t height, Mask& mask) {
  uint32_t side_x = 0, side_y = 0;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &side_x);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &side_y);
  std::vector<uint8_t> packed(static_cast<size_t>(TIFFTileSize(tiff)));
  const auto row_bytes = static_cast<size_t>(TIFFTileRowSize(tiff));
  if (side_x == 0 || side_y == 0 || packed.size() < row_bytes * side_y) return false;
  for (uint32_t y = 0; y < height; y += side_y) {
    for (uint32_t x = 0; x < width; x += side_x) {
      if (TIFFReadTile(tiff, packed.data(), x, y, 0, 0) < 0) return false;
      const Block block{x, y, std::min(side_x, width - x), std::min(side_y, height - y), row_bytes};
      unpack(packed, block, bits, width, mask);
    }
  }
  return true;
}

bool readRows(TIFF* tiff, int bits, uint32_t width, uint32_t height, Mask& mask) {
  std::vector<uint8_t> packed(static_cast<size_t>(TIFFScanlineSize(tiff)));
  for (uint32_t y = 0; y < height; ++y) {
    if (TIFFReadScanline(tiff, packed.data(), y, 0) < 0) return false;
    unpack(packed, {0, y, width, 1, packed.size()}, bits, width, mask);
  }
  return true;
}

/// Of the current directory, whose size is known.
Result<Mask> readCurrent(const TiffFile& file, const std::string& path, uint32_t width,
                         uint32_t height) {
  TIFF* const tiff = file.get();
  const int bits = shortTag(tiff, TIFFTAG_BITSPERSAMPLE);
  if ((bits != 1 && bits != 8) || shortTag(tiff, TIFFTAG_SAMPLESPERPIXEL) != 1) {
    return Status(TKS_USAGE, "the mask of " + quoted(path) + " is not one band of 1 or 8 bits");
  }
  Mask mask(size_t{width} * height);
  const bool read = TIFFIsTiled(tiff) ? readTiles(tiff, bits, width, height, mask)
                                      : readRows(tiff, bits, width, height, mask);
  if (!read) return file.failure();
  return mask;
}

}  // namespace

Result<Mask> readMaskPage(const std::string& path, uint32_t width, uint32_t height) {
  const auto file = TiffFile::open(path, "r");
  if (!file.ok()) return file.status();
  while (TIFFReadDirectory(file->get())) {
    if (isMaskPage(file->get(), width, height)) return readCurrent(*file, path, width, height);
  }
  return Mask();
}

Result<Mask> readMaskBeside(const std::string& path, uint32_t width, uint32_t height) {
  const std::string name = path + ".msk";
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(name, ignored)) return Mask();
  const auto file = TiffFile::open(name, "r");
  if (!file.ok()) return file.status();
  if (sizeOfPage(file->get()) != std::pair(width, height)) {
    return Status(TKS_USAGE, quoted(name) + " is a mask of another size than " + quoted(path));
  }
  return readCurrent(*file, name, width, height);
}

Result<Mask> maskOfMissing(const std::string& path, uint32_t width, uint32_t height) {
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
