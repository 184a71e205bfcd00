// SPDX-License-Identifier: Apache-2.0
// Images on disk: lossless formats are exact, conversions are told, the rest is refused.
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <tuple>

#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/files.hpp"
#include "conformance/samples/header_seal.hpp"
#include "tests/support/image_pixels.hpp"
#include "tests/support/same_bytes.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/tiny_tiff.hpp"

namespace tetrakis::tools {
namespace {

using test::expectPixels;
using test::randomImage;
using test::ScratchFolder;
using test::TinyTiff;

class ImageFiles : public ScratchFolder {};

TEST_F(ImageFiles, LosslessFormatsAreExact) {
  for (const tks_sample sample : {TKS_U8, TKS_U16}) {
    for (uint32_t channels = 1; channels <= 4; ++channels) {
      for (const auto& [width, height] : {std::pair{1U, 1U}, {1U, 300U}, {257U, 2U}, {64U, 65U}}) {
        const ImageFile image = randomImage(width, height, channels, sample);
        for (const char* format : {"png", "tif"}) {
          SCOPED_TRACE(std::string(format) + " " + std::to_string(channels));
          ASSERT_TRUE(writeImage(path("a"), image, format).ok());
          std::string note = "unset";
          const auto read = readImage(path("a"), &note);
          ASSERT_TRUE(read.ok()) << read.status().message();
          EXPECT_EQ(note, "");
          EXPECT_EQ(read->width, width);
          EXPECT_EQ(read->height, height);
          EXPECT_EQ(read->channels, channels);
          EXPECT_EQ(read->sample, sample);
          EXPECT_TRUE(read->data == image.data);
        }
      }
    }
  }
}

TEST_F(ImageFiles, FormatsThatOpenImageIoWritesAreExactWhereTheyAreTaken) {
  int taken = 0;
  for (const char* name : {"bmp", "ico", "iff", "jp2", "pgm", "ppm", "rla", "sgi", "tga"}) {
    for (uint32_t channels = 1; channels <= 4; ++channels) {
      for (const tks_sample sample : {TKS_U8, TKS_U16}) {
        SCOPED_TRACE(std::string(name) + " " + std::to_string(channels));
        const std::string file = path(std::string("a.") + name);
        // Even sides: see writeOther on formats that fail with others.
        const ImageFile image = randomImage(64, 64, channels, sample);
        const Status judged = checkImageFormat(file, {.channels = channels, .sample = sample});
        const Status written = writeImage(file, image);
        EXPECT_EQ(judged.code(), written.code()) << written.message();
        if (!written.ok()) continue;
        const auto read = readImage(file);
        ASSERT_TRUE(read.ok()) << read.status().message();
        EXPECT_TRUE(read->data == image.data);
        ++taken;
      }
    }
  }
  EXPECT_GT(taken, 30);
}

TEST_F(ImageFiles, LossyFormatsAreCloseAndFloatFormatsRefused) {
  ImageFile image{64, 64, 3, TKS_U8, std::vector<std::byte>(64 * 64 * 3, std::byte{100})};
  ASSERT_TRUE(writeImage(path("a.webp"), image).ok());
  const auto read = readImage(path("a.webp"));
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_NEAR(int(read->data[0]), 100, 3);
  for (const char* name : {"a.exr", "a.hdr", "a.dpx", "a.fits", "a.xyz", "a"})
    EXPECT_EQ(checkImageFormat(path(name), {.channels = 3}).code(), TKS_USAGE) << name;
}

TEST_F(ImageFiles, FurtherPagesAreTold) {
  std::vector<uint8_t> file = TinyTiff(2, 1, 1, 8, {1, 2}).bytes();
  uint32_t first = 0;
  std::memcpy(&first, &file[4], 4);
  const std::vector<uint8_t> directory(file.begin() + first, file.end());
  std::string note = "unset";
  expectPixels(readImage(save("one.tif", file), &note), {1, 2});
  EXPECT_EQ(note, "");
  const auto second = uint32_t(file.size());
  std::memcpy(&file[file.size() - 4], &second, 4);
  file.insert(file.end(), directory.begin(), directory.end());
  expectPixels(readImage(save("two.tif", file), &note), {1, 2});
  EXPECT_NE(note.find("pages"), std::string::npos);
}

TEST_F(ImageFiles, OrientationInPngIsApplied) {
  ASSERT_TRUE(writeImage(path("a.png"), randomImage(3, 2, 1, TKS_U8)).ok());
  const auto plain = readImage(path("a.png"));
  const auto stored = readBytes(path("a.png"));
  ASSERT_TRUE(plain.ok() && stored.ok());
  std::vector<uint8_t> file;
  for (const std::byte byte : *stored) file.push_back(uint8_t(byte));
  // TIFF with one tag, orientation 3: turned by half a circle.
  std::vector<uint8_t> chunk{'e', 'X', 'I', 'f', 'I', 'I', 42, 0, 8, 0, 0, 0, 1, 0, 0x12,
                             1,   3,   0,   1,   0,   0,   0,  3, 0, 0, 0, 0, 0, 0, 0};
  const uint32_t crc = test::crc32(chunk);
  for (int shift = 24; shift >= 0; shift -= 8) chunk.push_back(uint8_t(crc >> shift));
  chunk.insert(chunk.begin(), {0, 0, 0, 26});
  constexpr size_t kBehindHeader = 33;
  file.insert(file.begin() + kBehindHeader, chunk.begin(), chunk.end());
  std::vector<uint8_t> turned;
  for (const std::byte byte : plain->data) turned.insert(turned.begin(), uint8_t(byte));
  std::string note;
  expectPixels(readImage(save("b.png", file), &note), turned);
  EXPECT_NE(note.find("orientation"), std::string::npos);
}

TEST_F(ImageFiles, JpegIsCloseAndGrowsWithQuality) {
  for (const uint32_t channels : {1U, 3U}) {
    ImageFile image{61, 47, channels, TKS_U8, {}};
    for (uint32_t i = 0; i < 61 * 47 * channels; ++i) {
      image.data.push_back(static_cast<std::byte>(std::lround(128 + 100 * std::sin(i * 0.003))));
    }
    ASSERT_TRUE(writeImage(path("a.jpg"), image).ok());
    const auto read = readImage(path("a.jpg"));
    ASSERT_TRUE(read.ok()) << read.status().message();
    ASSERT_EQ(read->data.size(), image.data.size());
    for (size_t i = 0; i < image.data.size(); ++i) {
      EXPECT_NEAR(int(read->data[i]), int(image.data[i]), 8);
    }
    const auto coarse = encodeJpeg(image, 20), fine = encodeJpeg(image, 95);
    ASSERT_TRUE(coarse.ok() && fine.ok());
    EXPECT_LT(coarse->size(), fine->size());
  }
}

TEST_F(ImageFiles, JpegRefusesWhatItCannotHold) {
  EXPECT_EQ(encodeJpeg(randomImage(4, 4, 4, TKS_U8), 90).status().code(), TKS_USAGE);
  EXPECT_EQ(encodeJpeg(randomImage(4, 4, 3, TKS_U16), 90).status().code(), TKS_USAGE);
  EXPECT_EQ(encodeJpeg(randomImage(70000, 1, 1, TKS_U8), 90).status().code(), TKS_USAGE);
  EXPECT_EQ(writeImage(path("a.jpg"), randomImage(4, 4, 2, TKS_U8)).code(), TKS_USAGE);
  EXPECT_FALSE(std::filesystem::exists(path("a.jpg")));
}

TEST_F(ImageFiles, PalettesAreExpandedAndTold) {
  // 2 x 1 pixels, indices 1 and 0 into (10, 20, 30), (40, 50, 60).
  const std::vector<uint8_t> png{
      0x89, 0x50, 0x4E, 0x47, 0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D, 0x49, 0x48, 0x44,
      0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x03, 0x00, 0x00, 0x00, 0xC3,
      0xFC, 0x8F, 0xB8, 0x00, 0x00, 0x00, 0x06, 0x50, 0x4C, 0x54, 0x45, 0x0A, 0x14, 0x1E, 0x28,
      0x32, 0x3C, 0xD5, 0x1B, 0xB4, 0xE9, 0x00, 0x00, 0x00, 0x0B, 0x49, 0x44, 0x41, 0x54, 0x78,
      0xDA, 0x63, 0x60, 0x64, 0x00, 0x00, 0x00, 0x05, 0x00, 0x02, 0x42, 0xC2, 0x44, 0x9F, 0x00,
      0x00, 0x00, 0x00, 0x49, 0x45, 0x4E, 0x44, 0xAE, 0x42, 0x60, 0x82};
  std::string note;
  expectPixels(readImage(save("a.png", png), &note), {40, 50, 60, 10, 20, 30});
  EXPECT_NE(note.find("palette"), std::string::npos);
  EXPECT_EQ(readHeights(path("a.png")).status().code(), TKS_USAGE);

  TinyTiff tiff(2, 1, 1, 8, {1, 0});
  tiff.shorts(TinyTiff::kPhotometric, {3});
  std::vector<uint16_t> colours(3 * 256);
  for (size_t channel = 0; channel < 3; ++channel) {
    colours[256 * channel] = uint16_t(257 * 10 * (channel + 1));
    colours[256 * channel + 1] = uint16_t(257 * 10 * (channel + 4));
  }
  tiff.shorts(TinyTiff::kColorMap, colours);
  note.clear();
  expectPixels(readImage(save("a.tif", tiff.bytes()), &note), {40, 50, 60, 10, 20, 30});
  EXPECT_NE(note.find("palette"), std::string::npos);
}

TEST_F(ImageFiles, PalettesOfFewBitsAreExpanded) {
  struct Depth {
    uint16_t bits;
    std::vector<uint8_t> rows;  ///< each begins a byte
  };
  // Three pixels a row: the places 1, 0, 1 and 0, 1, 1.
  for (const auto& [bits, rows] :
       {Depth{1, {0xA0, 0x60}}, Depth{2, {0x44, 0x14}}, Depth{4, {0x10, 0x10, 0x01, 0x10}}}) {
    TinyTiff tiff(3, 2, 1, bits, rows);
    tiff.shorts(TinyTiff::kPhotometric, {3});
    const size_t places = size_t{1} << bits;
    std::vector<uint16_t> colours(3 * places);
    for (size_t channel = 0; channel < 3; ++channel) {
      colours[places * channel] = uint16_t(257 * 10 * (channel + 1));
      colours[places * channel + 1] = uint16_t(257 * 10 * (channel + 4));
    }
    tiff.shorts(TinyTiff::kColorMap, colours);
    std::string note;
    expectPixels(readImage(save("a.tif", tiff.bytes()), &note),
                 {40, 50, 60, 10, 20, 30, 40, 50, 60, 10, 20, 30, 40, 50, 60, 40, 50, 60});
    EXPECT_NE(note.find("palette"), std::string::npos) << bits;
    const Status heights = readHeights(path("a.tif")).status();
    EXPECT_NE(heights.message().find("palette"), std::string::npos) << heights.message();
  }
}

TEST_F(ImageFiles, SamplesThatNothingHasAreNamed) {
  struct Case {
    uint16_t format, bits;
    const char* word;
  };
  for (const auto& [format, bits, word] :
       {Case{1, 64, "64 bits"}, Case{2, 64, "64 bits"}, Case{5, 32, "complex"},
        Case{6, 64, "complex"}, Case{6, 128, "complex"}}) {
    TinyTiff tiff(2, 1, 1, bits, std::vector<uint8_t>(bits / 4));
    tiff.shorts(TinyTiff::kSampleFormat, {format});
    const std::string name = save("a.tif", tiff.bytes());
    for (const Status& status : {readImage(name).status(), readHeights(name).status()}) {
      EXPECT_EQ(status.code(), TKS_USAGE);
      EXPECT_NE(status.message().find(word), std::string::npos) << status.message();
    }
  }
}

/// Two pixels, blue and red, with colours of 24 bits and with a palette (Windows 3 headers).
TEST_F(ImageFiles, OnlyBitmapsWithAPaletteAreSaidToHaveOne) {
  const auto bitmap = [](uint8_t bits, std::vector<uint8_t> behind) {
    const auto pixels = uint8_t(54 + (bits == 8 ? 8 : 0)), colours = uint8_t(bits == 8 ? 2 : 0);
    std::vector<uint8_t> file{'B', 'M',    uint8_t(54 + behind.size()),
                              0,   0,      0,
                              0,   0,      0,
                              0,   pixels, 0,
                              0,   0,      40,
                              0,   0,      0,
                              2,   0,      0,
                              0,   1,      0,
                              0,   0,      1,
                              0,   bits};
    file.resize(46);
    file.insert(file.end(), {colours, 0, 0, 0, 0, 0, 0, 0});
    file.insert(file.end(), behind.begin(), behind.end());
    return file;
  };
  std::string note = "unset";
  expectPixels(readImage(save("a.bmp", bitmap(24, {255, 0, 0, 0, 0, 255, 0, 0})), &note),
               {0, 0, 255, 255, 0, 0});
  EXPECT_EQ(note, "");
  expectPixels(readImage(save("b.bmp", bitmap(8, {255, 0, 0, 0, 0, 0, 255, 0, 0, 1, 0, 0})), &note),
               {0, 0, 255, 255, 0, 0});
  EXPECT_NE(note.find("palette"), std::string::npos);
}

TEST_F(ImageFiles, CmykIsConvertedAndTold) {
  TinyTiff tiff(1, 1, 4, 8, {0, 255, 255, 0});  // no cyan, full magenta and yellow: red
  tiff.shorts(TinyTiff::kPhotometric, {5});
  std::string note;
  expectPixels(readImage(save("a.tif", tiff.bytes()), &note), {255, 0, 0});
  EXPECT_NE(note.find("CMYK"), std::string::npos);
}

TEST_F(ImageFiles, SixteenBitsThatHoldEightAreTold) {
  for (const uint16_t odd : {uint16_t{0}, uint16_t{1}}) {
    ImageFile image = randomImage(5, 4, 1, TKS_U16);
    for (size_t i = 0; i < image.data.size(); i += 2) image.data[i + 1] = image.data[i];
    image.data[8] ^= std::byte(odd);
    ASSERT_TRUE(writeImage(path("a.png"), image).ok());
    std::string note;
    ASSERT_TRUE(readImage(path("a.png"), &note).ok());
    EXPECT_EQ(note.find("16 bits say no more than 8") != std::string::npos, odd == 0) << note;
  }
}

/// What samples of 32 bits stand for is not scaled: 16 hold them all, or they are refused.
TEST_F(ImageFiles, WideSamplesKeepTheirValues) {
  TinyTiff tiff(2, 1, 1, 32, {0x0c, 0x04, 0, 0, 0xff, 0xff, 0, 0});
  std::string note;
  const auto image = readImage(save("a.tif", tiff.bytes()), &note);
  ASSERT_TRUE(image.ok()) << image.status().message();
  EXPECT_EQ(image->sample, TKS_U16);
  const std::array<uint16_t, 2> values{0x040c, 0xffff};
  EXPECT_TRUE(test::sameBytes(image->data, std::as_bytes(std::span(values))));
  EXPECT_NE(note.find("32 bits"), std::string::npos);
  TinyTiff wider(2, 1, 1, 32, {0x0c, 0x04, 0, 0, 0, 0, 1, 0});
  const Status refused = readImage(save("b.tif", wider.bytes())).status();
  EXPECT_EQ(refused.code(), TKS_USAGE);
  EXPECT_NE(refused.message().find("65535"), std::string::npos) << refused.message();
}

TEST_F(ImageFiles, ColoursThatAreNoRgbAreRefused) {
  TinyTiff tiff(2, 1, 3, 8, {50, 128, 128, 90, 128, 128});
  tiff.shorts(TinyTiff::kPhotometric, {8});
  const Status refused = readImage(save("a.tif", tiff.bytes())).status();
  EXPECT_EQ(refused.code(), TKS_USAGE);
  EXPECT_NE(refused.message().find("L*a*b*"), std::string::npos) << refused.message();
}

/// Of reflectances and of sensors that have 12 bits.
TEST_F(ImageFiles, PartsOfSixteenBitsHaveAWhiteLevel) {
  for (const uint32_t channels : {1U, 3U, 4U}) {
    for (const uint16_t most : {uint16_t{3124}, uint16_t{30000}}) {
      ImageFile image{8, 8, channels, TKS_U16, std::vector<std::byte>(size_t{128} * channels)};
      for (size_t i = 0; i < size_t{64} * channels; ++i) {
        const bool alpha = channels == 4 && i % 4 == 3;
        const uint16_t sample = alpha ? UINT16_MAX : i % 7 == 0 ? most : uint16_t{900};
        std::memcpy(&image.data[2 * i], &sample, sizeof sample);
      }
      ASSERT_TRUE(writeImage(path("a.tif"), image).ok());
      const Result<ImageFile> read = readImage(path("a.tif"));
      ASSERT_TRUE(read.ok());
      EXPECT_EQ(read->white(), most == 3124 ? 3124u : 65535u);
    }
  }
}

TEST_F(ImageFiles, FewBitsAreWidenedToFullRange) {
  const TinyTiff tiff(4, 1, 1, 4, {0x0F, 0x50});
  expectPixels(readImage(save("a.tif", tiff.bytes())), {0, 255, 85, 0});
  const TinyTiff bilevel(9, 1, 1, 1, {0b10100000, 0b10000000});
  expectPixels(readImage(save("b.tif", bilevel.bytes())), {255, 0, 255, 0, 0, 0, 0, 0, 255});
}

TEST_F(ImageFiles, WhiteIsZeroIsTurnedOver) {
  TinyTiff bilevel(9, 1, 1, 1, {0b10100000, 0b10000000});
  bilevel.shorts(TinyTiff::kPhotometric, {0});
  expectPixels(readImage(save("a.tif", bilevel.bytes())), {0, 255, 0, 255, 255, 255, 255, 255, 0});
  TinyTiff grey(2, 1, 1, 8, {0, 200});
  grey.shorts(TinyTiff::kPhotometric, {0});
  expectPixels(readImage(save("b.tif", grey.bytes())), {255, 55});
  TinyTiff deep(1, 1, 1, 16, {1, 2});
  deep.shorts(TinyTiff::kPhotometric, {0});
  expectPixels(readImage(save("c.tif", deep.bytes())), {0xFE, 0xFD});
  TinyTiff with_alpha(1, 1, 2, 8, {10, 20});
  with_alpha.shorts(TinyTiff::kPhotometric, {0});
  with_alpha.shorts(TinyTiff::kExtraSamples, {2});
  std::string note;
  expectPixels(readImage(save("d.tif", with_alpha.bytes()), &note), {245, 20});
  EXPECT_NE(note.find("white as 0"), std::string::npos) << note;
}

TEST_F(ImageFiles, FilesThatEndEarlyAreRefused) {
  const TinyTiff whole(4, 4, 1, 8, std::vector<uint8_t>(16, 9));
  TinyTiff behind = whole, across = whole;
  behind.longs(TinyTiff::kStripOffsets, {1000});
  across.longs(TinyTiff::kStripOffsets, {uint32_t(whole.bytes().size()) - 15});
  ASSERT_TRUE(readImage(save("whole.tif", whole.bytes())).ok());
  for (const TinyTiff& tiff : {behind, across}) {
    const std::string file = save("cut.tif", tiff.bytes());
    EXPECT_EQ(readImage(file).status().code(), TKS_IO) << readImage(file).status().message();
    EXPECT_EQ(readHeights(file).status().code(), TKS_IO);
  }
  const auto jpeg = encodeJpeg(randomImage(64, 64, 3, TKS_U8), 90);
  ASSERT_TRUE(jpeg.ok());
  for (const size_t bytes : {jpeg->size() / 2, jpeg->size() - 1}) {
    const auto read = readImage(save("cut.jpg", std::vector(jpeg->begin(), jpeg->begin() + bytes)));
    EXPECT_EQ(read.status().code(), TKS_IO) << bytes;
  }
  // Padding before the last marker, which some cameras write.
  std::vector<std::byte> padded(jpeg->begin(), jpeg->end() - 2);
  padded.resize(padded.size() + 5);
  padded.insert(padded.end(), jpeg->end() - 2, jpeg->end());
  EXPECT_TRUE(readImage(save("padded.jpg", padded)).ok());
  const std::string ppm = "P6\n8 8\n255\nabc";
  const auto read = readImage(save("cut.ppm", std::vector(ppm.begin(), ppm.end())));
  EXPECT_EQ(read.status().code(), TKS_IO);
  EXPECT_NE(read.status().message().find("ends early"), std::string::npos);
}

TEST_F(ImageFiles, OrientationIsApplied) {
  TinyTiff tiff(3, 2, 1, 8, {1, 2, 3, 4, 5, 6});
  const std::tuple<uint16_t, std::vector<uint8_t>> upright[] = {
      {2, {3, 2, 1, 6, 5, 4}}, {3, {6, 5, 4, 3, 2, 1}}, {4, {4, 5, 6, 1, 2, 3}},
      {5, {1, 4, 2, 5, 3, 6}}, {6, {4, 1, 5, 2, 6, 3}}, {7, {6, 3, 5, 2, 4, 1}},
      {8, {3, 6, 2, 5, 1, 4}}};
  for (const auto& [orientation, pixels] : upright) {
    SCOPED_TRACE(orientation);
    tiff.shorts(TinyTiff::kOrientation, {orientation});
    std::string note;
    const auto image = readImage(save("a.tif", tiff.bytes()), &note);
    expectPixels(image, pixels);
    EXPECT_EQ(image->width, orientation < 5 ? 3U : 2U);
    EXPECT_NE(note.find("orientation"), std::string::npos);
  }
}

TEST_F(ImageFiles, ImagesThatAreNoneAreRefused) {
  HeightFile floats;
  floats.width = floats.height = 2;
  floats.sample = TKS_F32;
  floats.data.resize(16);
  ASSERT_TRUE(writeHeights(path("float.tif"), floats).ok());
  HeightFile is_signed = floats;
  is_signed.sample = TKS_I16;
  is_signed.data.resize(8);
  ASSERT_TRUE(writeHeights(path("signed.tif"), is_signed).ok());
  const TinyTiff five(1, 1, 5, 8, {1, 2, 3, 4, 5});
  const std::tuple<std::string, tks_status> refused[] = {
      {path("float.tif"), TKS_USAGE},
      {path("signed.tif"), TKS_USAGE},
      {save("five.tif", five.bytes()), TKS_USAGE},
      {path("missing.png"), TKS_IO},
      {save("text.png", std::vector<char>{'n', 'o'}), TKS_IO}};
  for (const auto& [file, code] : refused) {
    const auto read = readImage(file);
    EXPECT_EQ(read.status().code(), code) << file << ": " << read.status().message();
    EXPECT_NE(read.status().message().find(file), std::string::npos);
  }
}

TEST_F(ImageFiles, ImagesThatCannotBeWrittenFail) {
  const ImageFile image = randomImage(4, 4, 3, TKS_U8);
  EXPECT_EQ(writeImage(path("a.xyz"), image).code(), TKS_USAGE);
  EXPECT_EQ(writeImage(path("a"), image).code(), TKS_USAGE);
  EXPECT_EQ(writeImage(path("missing/a.png"), image).code(), TKS_IO);
  ImageFile wrong = image;
  wrong.data.pop_back();
  EXPECT_EQ(writeImage(path("a.png"), wrong).code(), TKS_USAGE);
  wrong = image;
  wrong.channels = 5;
  EXPECT_EQ(writeImage(path("a.png"), wrong).code(), TKS_USAGE);
}

TEST_F(ImageFiles, ImagesComeFromStandardInput) {
  const ImageFile image = randomImage(5, 6, 3, TKS_U8);
  ASSERT_TRUE(writeImage(path("a.png"), image).ok());
  ASSERT_NE(std::freopen(path("a.png").c_str(), "rb", stdin), nullptr);
  const auto read = readImage("-");
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_TRUE(read->data == image.data);
}

}  // namespace
}  // namespace tetrakis::tools
