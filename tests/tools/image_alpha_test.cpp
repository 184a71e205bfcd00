// SPDX-License-Identifier: Apache-2.0
// Images on disk: which channels are colours, and what becomes alpha (alpha, masks, nodata).
#include <algorithm>
#include <string>
#include <vector>

#include "apps/tools/files/files.hpp"
#include "tests/support/image_pixels.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/tiny_tiff.hpp"

namespace tetrakis::tools {
namespace {

using test::expectPixels;
using test::randomImage;
using test::ScratchFolder;
using test::TinyTiff;

class ImageAlpha : public ScratchFolder {};

/// Near infrared comes back as what it is, which only TIFF can say.
TEST_F(ImageAlpha, FurtherColoursAreToldFromAlpha) {
  for (const tks_sample sample : {TKS_U8, TKS_U16}) {
    for (const uint32_t channels : {2U, 4U}) {
      for (const bool opaque : {false, true}) {
        ImageFile image = randomImage(37, 20, channels, sample);
        image.opaque = opaque;
        ASSERT_TRUE(writeImage(path("a"), image, "tif").ok());
        const auto read = readImage(path("a"));
        ASSERT_TRUE(read.ok()) << read.status().message();
        EXPECT_EQ(read->hasFurtherColour(), opaque);
        EXPECT_TRUE(read->data == image.data);
        const Status png = writeImage(path("a.png"), image);
        EXPECT_EQ(png.ok(), !opaque) << png.message();
        const ImageFile picture = withoutFurtherColour(image);
        EXPECT_EQ(picture.channels, opaque ? channels - 1 : channels);
        const size_t pixel = channels * tks_sample_bytes(sample);
        const size_t shown = picture.channels * tks_sample_bytes(sample);
        for (size_t i = 0; i < size_t{37} * 20; ++i) {
          EXPECT_TRUE(std::equal(&picture.data[i * shown], &picture.data[i * shown] + shown,
                                 &image.data[i * pixel]));
        }
      }
    }
  }
}

TEST_F(ImageAlpha, AlphaThatReadingMultipliesIsRefused) {
  ImageFile image{8, 8, 4, TKS_U8, std::vector<std::byte>(8 * 8 * 4, std::byte{100})};
  ASSERT_TRUE(writeImage(path("a.webp"), image).ok());
  const auto read = readImage(path("a.webp"));
  EXPECT_EQ(read.status().code(), TKS_USAGE);
  EXPECT_NE(read.status().message().find("gdal_translate IN OUT.png"), std::string::npos);
}

TEST_F(ImageAlpha, AssociatedAlphaIsDividedOutAndTold) {
  TinyTiff tiff(3, 1, 2, 8, {50, 128, 7, 0, 90, 255});
  tiff.shorts(TinyTiff::kExtraSamples, {2});
  std::string note;
  expectPixels(readImage(save("a.tif", tiff.bytes()), &note), {50, 128, 7, 0, 90, 255});
  EXPECT_EQ(note, "");
  tiff.shorts(TinyTiff::kExtraSamples, {1});
  expectPixels(readImage(save("b.tif", tiff.bytes()), &note), {100, 128, 7, 0, 90, 255});
  EXPECT_NE(note.find("alpha"), std::string::npos);
}

/// As gdal_translate -colorinterp writes them: further samples beside grey, and metadata.
TEST_F(ImageAlpha, BandsOfOtherOrdersBecomeRgb) {
  const auto colours = [](const std::vector<std::string>& names) {
    std::string xml = "<GDALMetadata>\n";
    for (size_t i = 0; i < names.size(); ++i)
      xml += "  <Item name=\"COLORINTERP\" sample=\"" + std::to_string(i) +
             "\" role=\"colorinterp\">" + names[i] + "</Item>\n";
    return xml + "</GDALMetadata>";
  };
  const auto grey = [](uint16_t channels, std::vector<uint16_t> extras, uint16_t bits = 8) {
    std::vector<uint8_t> pixels(size_t{2} * channels * bits / 8);
    for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<uint8_t>(10 * (i + 1));
    TinyTiff tiff(2, 1, channels, bits, pixels);
    tiff.shorts(TinyTiff::kPhotometric, {1});
    if (!extras.empty()) tiff.shorts(TinyTiff::kExtraSamples, extras);
    return tiff;
  };
  std::string note;
  TinyTiff near_infrared = grey(4, {0, 0, 0});
  near_infrared.ascii(TinyTiff::kGdalMetadata, colours({"Blue", "Green", "Red", "Undefined"}));
  auto read = readImage(save("bgrn.tif", near_infrared.bytes()), &note);
  expectPixels(read, {30, 20, 10, 40, 70, 60, 50, 80});
  EXPECT_TRUE(read->hasFurtherColour());
  EXPECT_NE(note.find("bands taken in the order 3, 2, 1, 4"), std::string::npos) << note;

  TinyTiff wide = grey(3, {0, 0}, 16);
  wide.ascii(TinyTiff::kGdalMetadata, colours({"Blue", "Green", "Red"}));
  expectPixels(readImage(save("bgr.tif", wide.bytes()), &note),
               {50, 60, 30, 40, 10, 20, 110, 120, 90, 100, 70, 80});

  // Alpha is where ExtraSamples say so, wherever that is, or where the metadata do.
  TinyTiff first = grey(4, {0, 0, 2});
  first.ascii(TinyTiff::kGdalMetadata, colours({"Red", "Green", "Blue"}));
  read = readImage(save("rgba.tif", first.bytes()), &note);
  expectPixels(read, {10, 20, 30, 40, 50, 60, 70, 80});
  EXPECT_TRUE(read->hasAlpha());
  EXPECT_EQ(note, "");
  TinyTiff turned = grey(4, {0, 0, 0});
  turned.ascii(TinyTiff::kGdalMetadata, colours({"Alpha", "Blue", "Green", "Red"}));
  read = readImage(save("abgr.tif", turned.bytes()), &note);
  expectPixels(read, {40, 30, 20, 10, 80, 70, 60, 50});
  EXPECT_TRUE(read->hasAlpha());

  // What lies beside the file goes before; what nobody tells stays where it is.
  expectPixels(readImage(save("plain.tif", grey(4, {0, 0, 0}).bytes()), &note),
               {10, 20, 30, 40, 50, 60, 70, 80});
  const std::string pam =
      "<PAMDataset><PAMRasterBand band=\"1\"><ColorInterp>Blue</ColorInterp></PAMRasterBand>"
      "<PAMRasterBand band=\"3\"><ColorInterp>Red</ColorInterp></PAMRasterBand></PAMDataset>";
  save("beside.tif.aux.xml", std::vector<char>(pam.begin(), pam.end()));
  const auto beside = readImage(save("beside.tif", grey(3, {0, 0}).bytes()), &note);
  expectPixels(beside, {30, 10, 20, 60, 40, 50});

  TinyTiff two = grey(3, {0, 2});
  EXPECT_EQ(readImage(save("two.tif", two.bytes())).status().code(), TKS_USAGE);
}

/// As in GDAL, a texel is hidden where every band has its nodata value, and a file beside the
/// picture may tell them.
TEST_F(ImageAlpha, NodataBesideAPictureHidesTexels) {
  const auto saveBeside = [this](const std::string& name, const std::vector<int>& bands) {
    std::string pam = "<PAMDataset>";
    for (size_t i = 0; i < bands.size(); ++i) {
      pam += "<PAMRasterBand band=\"" + std::to_string(i + 1) + "\"><NoDataValue>" +
             std::to_string(bands[i]) + "</NoDataValue></PAMRasterBand>";
    }
    pam += "</PAMDataset>";
    save(name + ".aux.xml", std::vector<char>(pam.begin(), pam.end()));
    return save(name, TinyTiff(2, 1, 3, 8, {10, 20, 30, 40, 50, 60}).bytes());
  };
  std::string note;
  expectPixels(readImage(saveBeside("first.tif", {10, 20, 30}), &note),
               {10, 20, 30, 0, 40, 50, 60, 255});
  EXPECT_NE(note.find("nodata"), std::string::npos);
  for (const std::vector<int>& bands : {std::vector{10, 20}, {10, 20, 31}, {10, 10, 10}}) {
    expectPixels(readImage(saveBeside("all.tif", bands), &note), {10, 20, 30, 40, 50, 60});
    EXPECT_EQ(note, "");
  }
}

/// What users would not see otherwise: alpha that is not called so becomes a colour, nodata too.
TEST_F(ImageAlpha, WhatATiffMeansOtherwiseIsTold) {
  const auto noteOn = [this](const TinyTiff& tiff) {
    std::string note;
    EXPECT_TRUE(readImage(save("a.tif", tiff.bytes()), &note).ok());
    return note;
  };
  for (const uint16_t channels : {uint16_t{2}, uint16_t{4}}) {
    TinyTiff tiff(1, 1, channels, 8, std::vector<uint8_t>(channels, 9));
    EXPECT_NE(noteOn(tiff).find("taken for a colour"), std::string::npos);
    tiff.shorts(TinyTiff::kExtraSamples, {0});
    EXPECT_NE(noteOn(tiff).find("taken for a colour"), std::string::npos);
    tiff.shorts(TinyTiff::kExtraSamples, {2});
    EXPECT_EQ(noteOn(tiff), "");
  }
  constexpr uint16_t kNodata = 42113;
  TinyTiff tiff(1, 1, 4, 8, {1, 2, 3, 4});
  tiff.shorts(TinyTiff::kExtraSamples, {0});
  tiff.ascii(kNodata, "255");
  EXPECT_NE(noteOn(tiff).find("nodata"), std::string::npos);
}

/// Of texels that have the nodata value in all channels, which GDAL hides, not of others.
TEST_F(ImageAlpha, NodataBecomesAlpha) {
  constexpr uint16_t kNodata = 42113;
  const std::vector<uint8_t> samples{0, 0, 0, 0, 9, 0, 7, 7, 7, 0, 0, 0};
  TinyTiff tiff(4, 1, 3, 8, samples);
  expectPixels(readImage(save("a.tif", tiff.bytes())), samples);
  tiff.ascii(kNodata, "0");
  std::string note;
  expectPixels(readImage(save("a.tif", tiff.bytes()), &note),
               {0, 0, 0, 0, 0, 9, 0, 255, 7, 7, 7, 255, 0, 0, 0, 0});
  EXPECT_NE(note.find("nodata"), std::string::npos);
  for (const char* const other : {"8", "-9999", "300", "nan", "none", ""}) {
    TinyTiff whole(4, 1, 3, 8, samples);
    whole.ascii(kNodata, other);
    expectPixels(readImage(save("a.tif", whole.bytes()), &note), samples);
    EXPECT_EQ(note, "") << other;
  }
  TinyTiff nothing(2, 1, 1, 8, {5, 5});  // a picture of which nothing is there is one
  nothing.ascii(kNodata, "5");
  expectPixels(readImage(save("a.tif", nothing.bytes())), {5, 5});
  TinyTiff wide(2, 1, 1, 16, {44, 1, 255, 255});
  wide.ascii(kNodata, "65535");
  const auto read = readImage(save("a.tif", wide.bytes()));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->channels, 2u);
  TinyTiff narrow(4, 1, 1, 4, {0x0F, 0x50});  // 15 becomes 255, which is no nodata value
  narrow.ascii(kNodata, "15");
  expectPixels(readImage(save("a.tif", narrow.bytes()), &note), {0, 255, 255, 0, 85, 255, 0, 255});
  EXPECT_NE(note.find("nodata"), std::string::npos);
}

/// Palettes and shades as well: what counts is the sample that the file stores.
TEST_F(ImageAlpha, NodataIsWhatIsStored) {
  TinyTiff tiff(3, 1, 1, 8, {1, 0, 255});
  tiff.ascii(TinyTiff::kGdalNodata, "1");
  tiff.shorts(TinyTiff::kPhotometric, {0});
  std::string note;
  expectPixels(readImage(save("a.tif", tiff.bytes()), &note), {254, 0, 255, 255, 0, 255});
  std::vector<uint16_t> colours(3 * 256);
  for (size_t i = 0; i < 3; ++i) colours[256 * i + 1] = uint16_t(257 * (i + 10));
  tiff.shorts(TinyTiff::kPhotometric, {3});
  tiff.shorts(TinyTiff::kColorMap, colours);
  expectPixels(readImage(save("b.tif", tiff.bytes()), &note),
               {10, 11, 12, 0, 0, 0, 0, 255, 0, 0, 0, 255});
  EXPECT_NE(note.find("nodata value have alpha 0"), std::string::npos) << note;
}

/// A file that calls its last channel alpha and leaves it at 0 shows nothing.
TEST_F(ImageAlpha, AnAlphaThatHidesEverythingIsTold) {
  for (const uint8_t alpha : {uint8_t{0}, uint8_t{1}}) {
    TinyTiff tiff(2, 1, 4, 8, {1, 2, 3, 0, 4, 5, 6, alpha});
    tiff.shorts(TinyTiff::kExtraSamples, {2});
    std::string note;
    ASSERT_TRUE(readImage(save("a.tif", tiff.bytes()), &note).ok());
    EXPECT_EQ(note.find("hides every texel") != std::string::npos, alpha == 0) << note;
  }
}

/// 1 x 2 pixels, of which the second is left out.
TinyTiff maskPage() {
  TinyTiff mask(2, 1, 1, 8, {255, 0});
  mask.longs(TinyTiff::kSubfileType, {4});
  mask.shorts(TinyTiff::kPhotometric, {4});
  return mask;
}

TEST_F(ImageAlpha, MasksBecomeAlpha) {
  const std::vector<uint8_t> colours = {1, 2, 3, 4, 5, 6, 7, 8};
  for (const uint16_t channels : {uint16_t{1}, uint16_t{3}}) {
    TinyTiff tiff(2, 1, channels, 8,
                  std::vector<uint8_t>(colours.begin(), colours.begin() + 2 * channels));
    tiff.addPage(maskPage());
    std::string note;
    const auto image = readImage(save("a.tif", tiff.bytes()), &note);
    ASSERT_TRUE(image.ok()) << image.status().message();
    EXPECT_TRUE(image->hasAlpha());
    EXPECT_NE(note.find("mask kept as alpha"), std::string::npos) << note;
    if (channels == 1) expectPixels(image, {1, 255, 2, 0});
    if (channels == 3) expectPixels(image, {1, 2, 3, 255, 4, 5, 6, 0});
    tiff.shorts(TinyTiff::kOrientation, {2});  // mirrored, and the mask with it
    if (channels == 1) expectPixels(readImage(save("a.tif", tiff.bytes())), {2, 0, 1, 255});
  }
  const std::vector<uint8_t> wide = {1, 2, 3, 4};  // two samples of 16 bits, little endian
  TinyTiff tiff(2, 1, 1, 16, wide);
  tiff.addPage(maskPage());
  expectPixels(readImage(save("a.tif", tiff.bytes())), {1, 2, 255, 255, 3, 4, 0, 0});
}

TEST_F(ImageAlpha, MasksBesideTheFileBecomeAlpha) {
  ASSERT_TRUE(writeImage(path("a.png"), randomImage(2, 1, 3, TKS_U8)).ok());
  TinyTiff mask = maskPage();
  mask.remove(TinyTiff::kSubfileType);
  mask.shorts(TinyTiff::kPhotometric, {1});
  save("a.png.msk", mask.bytes());
  const auto image = readImage(path("a.png"));
  ASSERT_TRUE(image.ok()) << image.status().message();
  ASSERT_EQ(image->channels, 4U);
  EXPECT_EQ(uint8_t(image->data[3]), 255);
  EXPECT_EQ(uint8_t(image->data[7]), 0);
  save("a.png.msk", TinyTiff(1, 1, 1, 8, {0}).bytes());
  EXPECT_EQ(readImage(path("a.png")).status().code(), TKS_USAGE) << "of another size";
}

TEST_F(ImageAlpha, MasksBesideAnAlphaAreTold) {
  TinyTiff tiff(2, 1, 2, 8, {1, 255, 2, 128});
  tiff.shorts(TinyTiff::kExtraSamples, {2});
  tiff.addPage(maskPage());
  std::string note;
  expectPixels(readImage(save("a.tif", tiff.bytes()), &note), {1, 255, 2, 128});
  EXPECT_NE(note.find("mask not applied"), std::string::npos) << note;
}

}  // namespace
}  // namespace tetrakis::tools
