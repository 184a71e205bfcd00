// SPDX-License-Identifier: Apache-2.0
// Plain TIFFs come as they were written, whatever their type, channels, tiles and compression (of
// doubles in tiles OpenImageIO 2.4 makes garbage); and what is not plain is left alone.
#include <tiffio.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "tests/support/scratch_folder.hpp"
#include "tools/files/files.hpp"
#include "tools/files/pictures/plain_tiff.hpp"

namespace tetrakis::tools {
namespace {

struct Layout {
  PictureSample sample;
  uint16_t format, bits, channels, compression, predictor;
  uint32_t tile;  ///< its side; 0: strips
};

class PlainTiffs : public test::ScratchFolder {
 protected:
  static constexpr uint32_t kWidth = 37, kHeight = 21, kRows = 5;

  std::string write(const Layout& layout) {
    const std::string name = path("a.tif");
    TIFF* const tiff = TIFFOpen(name.c_str(), "w");
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, kWidth);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, kHeight);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, layout.bits);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, layout.format);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, layout.channels);
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC,
                 layout.channels < 3 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, layout.compression);
    if (layout.predictor) TIFFSetField(tiff, TIFFTAG_PREDICTOR, layout.predictor);
    const uint16_t alpha = EXTRASAMPLE_UNASSALPHA;
    if (layout.channels % 2 == 0) TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &alpha);
    if (layout.tile) {
      TIFFSetField(tiff, TIFFTAG_TILEWIDTH, layout.tile);
      TIFFSetField(tiff, TIFFTAG_TILELENGTH, layout.tile);
    } else {
      TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, kRows);
    }
    writeNoise(tiff, layout);
    TIFFClose(tiff);
    return name;
  }

  /// Bytes below 64, so that floats are finite. They are kept in `written`.
  void writeNoise(TIFF* tiff, const Layout& layout) {
    std::mt19937 random(7);
    const size_t pixel = size_t{layout.channels} * layout.bits / 8, row = kWidth * pixel;
    written.resize(row * kHeight);
    for (std::byte& byte : written) byte = std::byte(random() % 64);
    if (layout.tile) return writeTiles(tiff, layout.tile, pixel);
    for (uint32_t y = 0; y < (first_block_only ? kRows : kHeight); ++y) {
      std::vector<std::byte> line(row);  // which the predictor changes
      std::copy_n(&written[y * row], row, line.data());
      TIFFWriteScanline(tiff, line.data(), y, 0);
    }
  }

  void writeTiles(TIFF* tiff, uint32_t side, size_t pixel) {
    std::vector<std::byte> tile(side * side * pixel);
    for (uint32_t y = 0; y < kHeight; y += side) {
      for (uint32_t x = 0; x < kWidth; x += side) {
        for (uint32_t line = y; line < std::min(y + side, kHeight); ++line)
          std::copy_n(&written[(line * kWidth + x) * pixel], std::min(side, kWidth - x) * pixel,
                      &tile[(line - y) * side * pixel]);
        TIFFWriteTile(tiff, tile.data(), x, y, 0, 0);
        if (first_block_only) return;
      }
    }
  }

  std::vector<std::byte> written;
  bool first_block_only = false;
};

std::vector<std::byte> samplesOf(PictureReader& reader, PictureSample type) {
  std::vector<std::byte> samples(reader.shape().samples() * sizeOf(type));
  const Status status = reader.read(type, samples);
  EXPECT_TRUE(status.ok()) << status.message();
  return samples;
}

TEST_F(PlainTiffs, ReadAsTheyWereWritten) {
  const std::vector<Layout> layouts = {
      {PictureSample::kU8, 1, 8, 1, COMPRESSION_NONE, 0, 0},
      {PictureSample::kU8, 1, 8, 2, COMPRESSION_LZW, 2, 16},
      {PictureSample::kU8, 1, 8, 3, COMPRESSION_ADOBE_DEFLATE, 2, 16},
      {PictureSample::kU8, 1, 8, 4, COMPRESSION_PACKBITS, 0, 0},
      {PictureSample::kU16, 1, 16, 1, COMPRESSION_ADOBE_DEFLATE, 2, 0},
      {PictureSample::kU16, 1, 16, 4, COMPRESSION_NONE, 0, 32},
      {PictureSample::kI16, 2, 16, 1, COMPRESSION_LZW, 2, 16},
      {PictureSample::kU32, 1, 32, 1, COMPRESSION_NONE, 0, 0},
      {PictureSample::kI32, 2, 32, 1, COMPRESSION_ADOBE_DEFLATE, 2, 16},
      {PictureSample::kFloat, 3, 32, 1, COMPRESSION_ADOBE_DEFLATE, 3, 16},
      {PictureSample::kDouble, 3, 64, 1, COMPRESSION_NONE, 0, 0},
      {PictureSample::kDouble, 3, 64, 1, COMPRESSION_ADOBE_DEFLATE, 3, 16},
  };
  for (const Layout& layout : layouts) {
    const std::string name = write(layout);
    const auto plain = openPlainTiff(name);
    ASSERT_TRUE(plain) << layout.bits << " bits, " << layout.channels << " channels";
    EXPECT_EQ(plain->shape().sample, layout.sample);
    EXPECT_EQ(plain->number("oiio:BitsPerSample"), layout.bits);
    EXPECT_EQ(samplesOf(*plain, layout.sample), written)
        << layout.bits << " bits, " << layout.channels << " channels, tiles of " << layout.tile;
  }
}

TEST_F(PlainTiffs, ConvertAsOpenImageIoDoes) {
  const auto plain = openPlainTiff(write({PictureSample::kU32, 1, 32, 1, COMPRESSION_NONE, 0, 0}));
  ASSERT_TRUE(plain);
  const auto halves = samplesOf(*plain, PictureSample::kU16);
  const auto wide = samplesOf(*plain, PictureSample::kU32);
  for (size_t i = 0; i < halves.size() / 2; ++i) {
    uint16_t half = 0;
    uint32_t whole = 0;
    std::memcpy(&half, &halves[2 * i], sizeof half);
    std::memcpy(&whole, &wide[4 * i], sizeof whole);
    EXPECT_NEAR(half, whole / 65537.0, 1);
  }
}

/// As GDAL's SPARSE_OK=TRUE leaves tiles and strips out.
TEST_F(PlainTiffs, WhatIsMissingIsVoid) {
  for (const uint32_t tile : {16U, 0U}) {
    const Layout layout{PictureSample::kFloat, 3, 32, 1, COMPRESSION_ADOBE_DEFLATE, 0, tile};
    first_block_only = true;
    const std::string name = write(layout);
    Notes notes;
    const auto heights = readHeights(name, {}, &notes);
    ASSERT_TRUE(heights.ok()) << heights.status().message();
    ASSERT_FALSE(notes.empty());
    EXPECT_NE(notes[0].text.find("leaves out are void"), std::string::npos) << notes[0].text;
    for (size_t i = 0; i < size_t{kWidth} * kHeight; ++i) {
      float sample = 0;
      std::memcpy(&sample, &heights->data[i * sizeof sample], sizeof sample);
      const bool there = tile ? i / kWidth < tile && i % kWidth < tile : i / kWidth < kRows;
      ASSERT_EQ(std::isnan(sample), !there) << i;
      if (there) {
        EXPECT_EQ(std::memcmp(&sample, &written[i * sizeof sample], sizeof sample), 0);
      }
    }
  }
  const auto image = readImage(write({PictureSample::kU8, 1, 8, 1, COMPRESSION_NONE, 0, 16}));
  EXPECT_EQ(image.status().code(), TKS_IO) << image.status().message();
}

TEST_F(PlainTiffs, OthersAreLeftAlone) {
  EXPECT_TRUE(openPlainTiff(write({PictureSample::kU8, 1, 8, 1, COMPRESSION_NONE, 0, 0})));
  EXPECT_FALSE(openPlainTiff(write({PictureSample::kHalf, 3, 16, 1, COMPRESSION_NONE, 0, 0})));
  EXPECT_FALSE(openPlainTiff(write({PictureSample::kOther, 1, 24, 1, COMPRESSION_NONE, 0, 0})));
  EXPECT_FALSE(openPlainTiff(path("missing.tif")));
}

}  // namespace
}  // namespace tetrakis::tools
