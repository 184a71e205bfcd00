// SPDX-License-Identifier: Apache-2.0
// TIFFs come as they were written, whatever their type, bits, channels, planes, tiles and
// compression (of doubles in tiles OpenImageIO 2.4 makes garbage).
#include <tiffio.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <span>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/pictures/picture_header.hpp"
#include "apps/tools/files/pictures/tiff_picture.hpp"
#include "apps/tools/files/pictures/tiff_samples.hpp"
#include "tests/support/scratch_folder.hpp"

namespace tetrakis::tools {
namespace {

struct Layout {
  PictureSample sample;
  uint16_t format, bits, channels, compression, predictor;
  uint32_t tile;  ///< its side; 0: strips
  bool apart = false;
};

class TiffPictures : public test::ScratchFolder {
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
    TIFFSetField(tiff, TIFFTAG_PLANARCONFIG,
                 layout.apart ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
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
    const size_t sample = layout.bits / 8;
    written.resize(kWidth * kHeight * layout.channels * sample);
    for (std::byte& byte : written) byte = std::byte(random() % 64);
    for (uint16_t plane = 0; plane < (layout.apart ? layout.channels : 1); ++plane) {
      if (layout.tile) {
        writeTiles(tiff, layout, plane);
      } else {
        for (uint32_t y = 0; y < (first_block_only ? kRows : kHeight); ++y) {
          std::vector<std::byte> line = part(layout, plane, 0, y, kWidth);
          TIFFWriteScanline(tiff, line.data(), y, plane);
        }
      }
    }
  }

  /// Of a row, in the order of the file: all channels or one. Predictors change what they get.
  std::vector<std::byte> part(const Layout& layout, uint16_t plane, uint32_t x, uint32_t y,
                              uint32_t width) const {
    const size_t sample = layout.bits / 8, pixel = layout.channels * sample;
    const std::byte* const from = &written[(y * kWidth + x) * pixel];
    if (!layout.apart) return {from, from + width * pixel};
    std::vector<std::byte> line;
    for (uint32_t i = 0; i < width; ++i)
      line.insert(line.end(), from + i * pixel + plane * sample,
                  from + i * pixel + (plane + 1) * sample);
    return line;
  }

  void writeTiles(TIFF* tiff, const Layout& layout, uint16_t plane) {
    const uint32_t side = layout.tile;
    const size_t row = side * (layout.apart ? 1 : layout.channels) * layout.bits / 8;
    std::vector<std::byte> tile(side * row);
    for (uint32_t y = 0; y < kHeight; y += side) {
      for (uint32_t x = 0; x < kWidth; x += side) {
        for (uint32_t line = y; line < std::min(y + side, kHeight); ++line) {
          const auto samples = part(layout, plane, x, line, std::min(side, kWidth - x));
          std::copy(samples.begin(), samples.end(), &tile[(line - y) * row]);
        }
        TIFFWriteTile(tiff, tile.data(), x, y, 0, plane);
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

TEST_F(TiffPictures, ReadAsTheyWereWritten) {
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
  for (Layout layout : layouts) {
    for (layout.apart = false;; layout.apart = true) {
      const auto read = openTiff(write(layout), "it", kMostHeights);
      ASSERT_TRUE(read.ok()) << read.status().message();
      EXPECT_EQ((*read)->shape().sample, layout.sample);
      EXPECT_EQ(samplesOf(**read, layout.sample), written)
          << layout.bits << " bits, " << layout.channels << " channels, tiles of " << layout.tile
          << (layout.apart ? ", planes apart" : "");
      if (layout.apart) break;
    }
  }
}

/// Every value of 16 bits as a float, against powers of two; all of 24 bits that are a half.
TEST_F(TiffPictures, SmallFloatsAreExact) {
  std::vector<std::byte> samples(sizeof(float));
  const auto unpacked = [&samples](uint32_t bits, uint16_t width) {
    unpackRow(std::as_bytes(std::span(&bits, 1)), {SAMPLEFORMAT_IEEEFP, width}, samples);
    float value = 0;
    std::memcpy(&value, samples.data(), sizeof value);
    return value;
  };
  for (uint32_t bits = 0; bits < 65536; ++bits) {
    const uint32_t exponent = bits >> 10 & 31U, mantissa = bits & 1023U;
    const float half = unpacked(bits, 16);
    ASSERT_EQ(std::signbit(half), bits >> 15 != 0);
    if (exponent == 31) {
      ASSERT_EQ(std::isnan(half), mantissa != 0);
      ASSERT_TRUE(std::isnan(half) || std::isinf(half));
      continue;
    }
    const double size = exponent == 0 ? std::ldexp(mantissa, -24)
                                      : std::ldexp(1024.0 + mantissa, int(exponent) - 25);
    ASSERT_EQ(std::abs(half), size) << bits;
    if (exponent == 0) continue;
    const uint32_t triple = (bits >> 15) << 23 | (exponent + 48) << 16 | mantissa << 6;
    ASSERT_EQ(unpacked(triple, 24), half) << bits;
  }
  EXPECT_EQ(unpacked(1, 24), std::ldexp(1.0F, -78));
  EXPECT_TRUE(std::isinf(unpacked(127U << 16, 24)));
}

/// Without gaps, highest bit first.
TEST_F(TiffPictures, FewBitsAreUnpacked) {
  std::mt19937 random(3);
  for (uint16_t bits = 1; bits <= 32; ++bits) {
    if (bits == 8 || bits == 16 || bits == 32) continue;  // words of the host
    constexpr size_t kCount = 13;
    std::vector<std::byte> packed((kCount * bits + 7) / 8);
    std::vector<uint32_t> values(kCount);
    for (size_t i = 0; i < kCount; ++i) {
      values[i] = uint32_t(random() & ((uint64_t{1} << bits) - 1));
      for (uint16_t bit = 0; bit < bits; ++bit)
        if (values[i] >> (bits - 1 - bit) & 1U)
          packed[(i * bits + bit) / 8] |= std::byte{128} >> (i * bits + bit) % 8;
    }
    const size_t size = sizeOf(typeOf({SAMPLEFORMAT_UINT, bits}));
    EXPECT_EQ(size, bits < 8 ? 1U : bits < 16 ? 2U : 4U);
    std::vector<std::byte> samples(kCount * size);
    unpackRow(packed, {SAMPLEFORMAT_UINT, bits}, samples);
    for (size_t i = 0; i < kCount; ++i) {
      uint32_t value = 0;
      std::memcpy(&value, &samples[i * size], size);
      EXPECT_EQ(value, values[i]) << bits;
    }
  }
}

/// As GDAL's SPARSE_OK=TRUE leaves tiles and strips out.
TEST_F(TiffPictures, WhatIsMissingIsVoid) {
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
}

/// Textures have 0 there, or an alpha of 0 where a nodata value is declared: as GDAL reads them.
TEST_F(TiffPictures, WhatIsMissingInTexturesIsZero) {
  first_block_only = true;
  for (const uint16_t channels : {uint16_t{1}, uint16_t{3}}) {
    for (const uint32_t tile : {16U, 0U}) {
      Layout layout{PictureSample::kU8, 1, 8, channels, COMPRESSION_NONE, 0, tile};
      for (layout.apart = false;; layout.apart = true) {
        std::string note;
        const auto image = readImage(write(layout), &note);
        ASSERT_TRUE(image.ok()) << image.status().message();
        EXPECT_NE(note.find("leaves out"), std::string::npos) << note;
        for (size_t i = 0; i < image->data.size(); ++i) {
          const size_t at = i / channels;
          const bool there = tile ? at / kWidth < tile && at % kWidth < tile : at / kWidth < kRows;
          ASSERT_EQ(image->data[i], there ? written[i] : std::byte{0});
        }
        if (layout.apart) break;
      }
    }
  }
}

TEST_F(TiffPictures, WhatCannotBeReadIsRefused) {
  EXPECT_FALSE(openTiff(path("missing.tif"), "it", kMostHeights).ok());
  const std::string name = write({PictureSample::kU8, 1, 8, 1, COMPRESSION_NONE, 0, 0});
  EXPECT_TRUE(openTiff(name, "it", kWidth).ok());
  EXPECT_EQ(openTiff(name, "it", kWidth - 1).status().code(), TKS_USAGE);
}

}  // namespace
}  // namespace tetrakis::tools
