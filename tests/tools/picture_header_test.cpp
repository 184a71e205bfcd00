// SPDX-License-Identifier: Apache-2.0
// Pictures are what their headers say: reserved bytes are no alpha, and no few bytes that claim
// many rows take time or memory.
#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "tests/support/image_pixels.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/tiny_tiff.hpp"

namespace tetrakis::tools {
namespace {

using test::expectPixels;
using test::ScratchFolder;

using Bytes = std::vector<uint8_t>;

void putLittle(Bytes& file, size_t at, uint64_t value, size_t bytes) {
  if (file.size() < at + bytes) file.resize(at + bytes);
  for (size_t i = 0; i < bytes; ++i) file[at + i] = uint8_t(value >> 8 * i);
}

void putBig(Bytes& file, size_t at, uint64_t value, size_t bytes) {
  if (file.size() < at + bytes) file.resize(at + bytes);
  for (size_t i = 0; i < bytes; ++i) file[at + i] = uint8_t(value >> 8 * (bytes - 1 - i));
}

Bytes startingAs(const std::string& text) {
  return {text.begin(), text.end()};
}

constexpr uint32_t kBitmapAlpha = 0xFF000000;

/// Two pixels in a row, 4 bytes each: blue, green, red, fourth.
Bytes bitmap(uint32_t header, uint32_t alpha_mask, const Bytes& pixels) {
  Bytes file = startingAs("BM");
  putLittle(file, 10, 14 + header, 4);
  putLittle(file, 14, header, 4);
  putLittle(file, 18, 2, 4);
  putLittle(file, 22, 1, 4);
  putLittle(file, 26, 1, 2);
  putLittle(file, 28, 32, 2);
  if (header > 40) {
    putLittle(file, 30, 3, 4);  // masks
    putLittle(file, 54, 0xFF0000, 4);
    putLittle(file, 58, 0xFF00, 4);
    putLittle(file, 62, 0xFF, 4);
    putLittle(file, 66, alpha_mask, 4);
  }
  file.resize(14 + header);
  file.insert(file.end(), pixels.begin(), pixels.end());
  putLittle(file, 2, file.size(), 4);
  return file;
}

Bytes targa(uint8_t attribute_bits, const Bytes& pixels) {
  Bytes file(18);
  file[2] = 2;
  putLittle(file, 12, 2, 2);
  putLittle(file, 14, 1, 2);
  file[16] = 32;
  file[17] = uint8_t(0x20 | attribute_bits);
  file.insert(file.end(), pixels.begin(), pixels.end());
  return file;
}

class PictureHeaders : public ScratchFolder {};

TEST_F(PictureHeaders, ReservedBytesAreNoAlpha) {
  const Bytes pixels{3, 2, 1, 0, 6, 5, 4, 0}, rgb{1, 2, 3, 4, 5, 6};
  for (const Bytes& file : {bitmap(40, 0, pixels), bitmap(108, 0, pixels), targa(0, pixels)}) {
    std::string note;
    const auto read = readImage(save("a", file), &note);
    expectPixels(read, rgb);
    EXPECT_EQ(read->channels, 3U);
    EXPECT_NE(note.find("does not use it"), std::string::npos) << note;
  }
}

TEST_F(PictureHeaders, AlphaIsWhatAHeaderCallsSo) {
  const Bytes pixels{3, 2, 1, 0, 6, 5, 4, 9}, rgba{1, 2, 3, 0, 4, 5, 6, 9};
  for (const Bytes& file : {bitmap(108, kBitmapAlpha, pixels), targa(8, pixels)}) {
    std::string note;
    expectPixels(readImage(save("a", file), &note), rgba);
    EXPECT_EQ(note, "");
  }
  std::string note;
  const Bytes hidden{3, 2, 1, 0, 6, 5, 4, 0};
  ASSERT_TRUE(readImage(save("a", bitmap(108, kBitmapAlpha, hidden)), &note).ok());
  EXPECT_NE(note.find("hides every texel"), std::string::npos) << note;
}

/// The kinds that OpenImageIO takes for others, or rounds.
TEST_F(PictureHeaders, WhatIsNotReadExactlyIsRefusedWithAWayOut) {
  Bytes fields = bitmap(108, 0, Bytes(8, 7));
  putLittle(fields, 54, 0xFF, 4);  // red where blue stands
  putLittle(fields, 62, 0xFF0000, 4);
  Bytes few = bitmap(40, 0, Bytes(8, 7));
  putLittle(few, 28, 16, 2);
  Bytes photoshop = startingAs("8BPS");
  putBig(photoshop, 12, 4, 2);
  putBig(photoshop, 14, 2, 4);
  putBig(photoshop, 18, 2, 4);
  putBig(photoshop, 22, 8, 2);
  putBig(photoshop, 24, 4, 2);  // CMYK
  for (const Bytes& file : {fields, few, photoshop}) {
    const Status refused = readImage(save("a", file)).status();
    EXPECT_EQ(refused.code(), TKS_USAGE) << refused.message();
    EXPECT_NE(refused.message().find("convert IN OUT.png"), std::string::npos);
  }
}

/// A header of each format that says that there are so many rows of one column.
std::vector<Bytes> claiming(uint32_t rows) {
  Bytes png = startingAs("\x89PNG\r\n\x1A\n");
  putBig(png, 16, 1, 4);
  putBig(png, 20, rows, 4);
  Bytes bmp = bitmap(40, 0, Bytes(8));
  putLittle(bmp, 22, rows, 4);
  Bytes dds = startingAs("DDS ");
  putLittle(dds, 12, rows, 4);
  putLittle(dds, 16, 1, 4);
  putLittle(dds, 80, 4, 4);
  dds.resize(128);
  std::copy_n("DXT1", 4, dds.begin() + 84);
  Bytes siz(100);
  putBig(siz, 0, 0xFF4FFF51, 4);
  putBig(siz, 8, 1, 4);
  putBig(siz, 12, rows, 4);
  putBig(siz, 40, 1, 2);
  siz[42] = 7;
  siz[43] = siz[44] = 1;
  Bytes photoshop = startingAs("8BPS");
  putBig(photoshop, 12, 1, 2);
  putBig(photoshop, 14, rows, 4);
  putBig(photoshop, 18, 1, 4);
  putBig(photoshop, 22, 8, 2);
  putBig(photoshop, 24, 1, 2);
  Bytes exr{0x76, 0x2F, 0x31, 0x01};
  const std::string window("dataWindow\0box2i\0\x10\0\0\0", 21);
  exr.insert(exr.end(), window.begin(), window.end());
  putLittle(exr, exr.size() + 12, rows - 1, 4);
  Bytes heif(100);
  std::copy_n("ftypavif", 8, heif.begin() + 4);
  std::copy_n("ispe", 4, heif.begin() + 40);
  putBig(heif, 48, 1, 4);
  putBig(heif, 52, rows, 4);
  Bytes iff = startingAs("FOR4    CIMGTBHD");
  putBig(iff, 20, 1, 4);
  putBig(iff, 24, rows, 4);
  const Bytes pgm = startingAs("P5\n1 " + std::to_string(rows) + "\n255\n");
  const Bytes tiff = test::TinyTiff(1, rows, 1, 8, {1}).bytes();
  return {png, bmp, dds, siz, photoshop, exr, heif, iff, pgm, tiff};
}

TEST_F(PictureHeaders, ClaimedSidesAreJudgedBeforeReading) {
  for (const uint32_t rows : {32769U, 1U << 21, 1U << 30, 0x7FFFFFFFU}) {
    for (const Bytes& file : claiming(rows)) {
      const std::string name = save("a", file);
      const auto start = std::chrono::steady_clock::now();
      const Status texture = readImage(name).status();
      EXPECT_EQ(texture.code(), TKS_USAGE) << texture.message();
      EXPECT_NE(texture.message().find(std::to_string(rows)), std::string::npos)
          << texture.message();
      if (rows > 1U << 20) {
        const Status heights = readHeights(name).status();
        EXPECT_EQ(heights.code(), TKS_USAGE) << heights.message();
      }
      EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
    }
  }
}

}  // namespace
}  // namespace tetrakis::tools
