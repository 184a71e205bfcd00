// SPDX-License-Identifier: Apache-2.0
// Heights on disk: every type and format comes back bit for bit; what is no height field is
// refused.
#include "apps/tools/files/files.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <tuple>

#include "tests/support/same_bytes.hpp"
#include "tests/support/scratch_folder.hpp"

namespace tetrakis::tools {
namespace {

using test::ScratchFolder;

struct Size {
  uint32_t width, height;
};
constexpr Size kSizes[] = {{2, 2}, {3, 1000}, {1000, 3}, {2, 7}, {129, 65}, {700, 300}};

/// Random bits: as floats these are denormals, infinities, NaNs with payloads and all else.
HeightFile randomHeights(Size size, tks_sample sample) {
  HeightFile heights;
  heights.width = size.width;
  heights.height = size.height;
  heights.sample = sample;
  heights.data.resize(size_t{size.width} * size.height * tks_sample_bytes(sample));
  std::mt19937 random(size.width * 31 + size.height + sample);
  for (std::byte& byte : heights.data) byte = static_cast<std::byte>(random());
  return heights;
}

template <class T>
HeightFile heightsFrom(const std::vector<T>& samples, uint32_t width, tks_sample sample) {
  HeightFile heights;
  heights.width = width;
  heights.height = static_cast<uint32_t>(samples.size()) / width;
  heights.sample = sample;
  heights.data.resize(samples.size() * sizeof(T));
  std::memcpy(heights.data.data(), samples.data(), heights.data.size());
  return heights;
}

void expectSameSamples(const Result<HeightFile>& read, const HeightFile& written) {
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_EQ(read->width, written.width);
  EXPECT_EQ(read->height, written.height);
  EXPECT_EQ(read->sample, written.sample);
  EXPECT_TRUE(test::sameBytes(read->data, written.data));
}

std::string nameOf(tks_sample sample) {
  static const char* const kNames[] = {"u8", "i8", "u16", "i16", "u32", "i32", "f32"};
  return kNames[sample];
}

class HeightTypes : public ScratchFolder, public ::testing::WithParamInterface<tks_sample> {};
INSTANTIATE_TEST_SUITE_P(All, HeightTypes,
                         ::testing::Values(TKS_U8, TKS_I8, TKS_U16, TKS_I16, TKS_U32, TKS_I32,
                                           TKS_F32),
                         [](const auto& parameter) { return nameOf(parameter.param); });

TEST_P(HeightTypes, TiffKeepsEveryBit) {
  for (const Size size : kSizes) {
    const HeightFile heights = randomHeights(size, GetParam());
    const Status written = writeHeights(path("a.tif"), heights);
    ASSERT_TRUE(written.ok()) << written.message();
    expectSameSamples(readHeights(path("a.tif")), heights);
  }
}

TEST_P(HeightTypes, RawKeepsEveryBit) {
  for (const Size size : kSizes) {
    const HeightFile heights = randomHeights(size, GetParam());
    ASSERT_TRUE(writeHeights(path("a.raw"), heights).ok());
    const std::string shape =
        ":" + std::to_string(size.width) + "x" + std::to_string(size.height) + ":";
    expectSameSamples(readHeights(path("a.raw") + shape + nameOf(GetParam())), heights);
  }
}

/// Formats either keep every bit or refuse the type.
TEST_P(HeightTypes, OtherFormatsAreExactOrRefuse) {
  const tks_sample sample = GetParam();
  const HeightFile heights = randomHeights({33, 33}, sample);
  const std::tuple<const char*, bool> formats[] = {{"png", sample == TKS_U8 || sample == TKS_U16},
                                                   {"exr", sample == TKS_U32 || sample == TKS_F32},
                                                   {"hgt", sample == TKS_I16}};
  for (const auto& [format, fits] : formats) {
    const std::string file = path(std::string("a.") + format);
    const Status written = writeHeights(file, heights);
    EXPECT_EQ(written.code(), fits ? TKS_OK : TKS_USAGE) << format << ": " << written.message();
    EXPECT_EQ(std::filesystem::exists(file), fits);
    if (fits) expectSameSamples(readHeights(file), heights);
  }
}

TEST_P(HeightTypes, FormatOverridesTheName) {
  const HeightFile heights = randomHeights({5, 4}, GetParam());
  ASSERT_TRUE(writeHeights(path("staged"), heights, "tif").ok());
  expectSameSamples(readHeights(path("staged")), heights);
}

class HeightFiles : public ScratchFolder {};

TEST_F(HeightFiles, NotableFloatsSurvive) {
  using Limits = std::numeric_limits<float>;
  const HeightFile heights =
      heightsFrom<float>({0.0F, -0.0F, Limits::denorm_min(), -Limits::denorm_min(), Limits::min(),
                          Limits::max(), Limits::lowest(), Limits::infinity(), -Limits::infinity(),
                          Limits::quiet_NaN(), 1.0F, 0x1.fffffep-127F},
                         4, TKS_F32);
  for (const char* format : {"tif", "exr"}) {
    ASSERT_TRUE(writeHeights(path("a"), heights, format).ok());
    expectSameSamples(readHeights(path("a")), heights);
  }
}

TEST_F(HeightFiles, TagsSurvive) {
  HeightFile heights = randomHeights({20, 10}, TKS_I16);
  heights.scale = 0.1;
  heights.offset = -1234.5678;
  heights.spacing_x = 30.000000001;
  heights.spacing_y = 1.0 / 3;
  heights.nodata = -32768;
  heights.unit = "ft";
  for (const char* datum : {"EPSG:5773", "EGM96 <&> \"height\"", ""}) {
    heights.vertical_datum = datum;
    ASSERT_TRUE(writeHeights(path("a.tif"), heights).ok());
    const auto read = readHeights(path("a.tif"));
    expectSameSamples(read, heights);
    EXPECT_EQ(read->scale, heights.scale);
    EXPECT_EQ(read->offset, heights.offset);
    EXPECT_EQ(read->spacing_x, heights.spacing_x);
    EXPECT_EQ(read->spacing_y, heights.spacing_y);
    EXPECT_EQ(read->nodata, heights.nodata);
    EXPECT_EQ(read->unit, heights.unit);
    EXPECT_EQ(read->vertical_datum, heights.vertical_datum);
  }
}

TEST_F(HeightFiles, NothingIsInventedWithoutTags) {
  ASSERT_TRUE(writeHeights(path("a.tif"), randomHeights({4, 4}, TKS_U16)).ok());
  const auto read = readHeights(path("a.tif"));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->scale, 1);
  EXPECT_EQ(read->offset, 0);
  EXPECT_EQ(read->spacing_x, 0);
  EXPECT_EQ(read->spacing_y, 0);
  EXPECT_FALSE(read->nodata);
  EXPECT_EQ(read->unit + read->vertical_datum + read->crs, "");
}

TEST_F(HeightFiles, FloatNodataMeetsTheSamplesBits) {
  for (const float nodata : {-std::numeric_limits<float>::max(), -9999.9F, 1e-40F}) {
    HeightFile heights = heightsFrom<float>({nodata, 1, 2, 3}, 2, TKS_F32);
    heights.nodata = nodata;
    ASSERT_TRUE(writeHeights(path("a.tif"), heights).ok());
    const auto read = readHeights(path("a.tif"));
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read->nodata, double{nodata});
  }
  HeightFile heights = randomHeights({2, 2}, TKS_F32);
  heights.nodata = -std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(writeHeights(path("a.tif"), heights).ok());
  const auto read = readHeights(path("a.tif"));
  ASSERT_TRUE(read.ok() && read->nodata);
  EXPECT_TRUE(std::isnan(*read->nodata));
}

TEST_F(HeightFiles, HgtIsBigEndianAndKnowsItsPlace) {
  const std::vector<uint8_t> bytes{0x01, 0x02, 0x80, 0x00, 0xFF, 0xFF, 0x00, 0x03};
  const HeightFile expected = heightsFrom<int16_t>({0x0102, -32768, -1, 3}, 2, TKS_I16);
  const auto read = readHeights(save("S46W122.hgt", bytes));
  expectSameSamples(read, expected);
  EXPECT_EQ(read->nodata, -32768);
  EXPECT_EQ(read->unit, "m");
  // One degree at latitude -45.5, by the usual series for WGS 84: 111412.84 cos p - 93.5 cos 3p +
  // 0.118 cos 5p along the parallel, 111132.92 - 559.82 cos 2p + 1.175 cos 4p along the meridian.
  EXPECT_NEAR(read->spacing_x, 78158.0, 0.2);
  EXPECT_NEAR(read->spacing_y, 111141.5, 0.2);
  const auto elsewhere = readHeights(save("tile.hgt", bytes));
  ASSERT_TRUE(elsewhere.ok());
  EXPECT_EQ(elsewhere->spacing_x, 0);
}

/// NASADEM's tiles of floats, and its names.
TEST_F(HeightFiles, NasademIsReadAsItIsCalled) {
  const std::vector<uint8_t> bytes{0x3F, 0x80, 0, 0, 0xC6, 0xFF, 0xFE, 0,
                                   0x41, 0x20, 0, 0, 0,    0,    0,    0};
  for (const char* name : {"n46w122.hgts", "NASADEM_SHHP_n46w122.hgts"}) {
    Notes notes;
    const auto read = readHeights(save(name, bytes), {}, &notes);
    expectSameSamples(read, heightsFrom<float>({1, -32767, 10, 0}, 2, TKS_F32));
    ASSERT_TRUE(read->geotransform) << name;
    EXPECT_EQ((*read->geotransform)[0], -122.5);
    EXPECT_TRUE(notes.empty());
  }
  const std::vector<uint8_t> square(8, 7);
  Notes notes;
  EXPECT_TRUE(readHeights(save("NASADEM_HGT_s01e002.hgt", square), {}, &notes)->geotransform);
  EXPECT_TRUE(notes.empty());
  ASSERT_TRUE(readHeights(save("tile.hgt", square), {}, &notes).ok());
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].text.find("N46W122.hgt"), std::string::npos);
}

/// As of one arc-second beyond 50 degrees.
TEST_F(HeightFiles, HgtMayHaveHalfTheColumns) {
  const auto read = readHeights(save("N60E007.hgt", std::vector<uint8_t>(2 * 1801 * 3601)));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->width, 1801U);
  EXPECT_EQ(read->height, 3601U);
  ASSERT_TRUE(read->geotransform);
  EXPECT_DOUBLE_EQ((*read->geotransform)[1], 1. / 1800);
  EXPECT_DOUBLE_EQ((*read->geotransform)[5], -1. / 3600);
  EXPECT_NEAR(read->spacing_y, 30.95, 0.01);
}

TEST_F(HeightFiles, RawIsLittleEndian) {
  const std::string file = save("a.raw", std::vector<uint8_t>{1, 0, 2, 0, 0, 1, 0xFF, 0xFF});
  expectSameSamples(readHeights(file + ":2x2:u16"),
                    heightsFrom<uint16_t>({1, 2, 256, 65535}, 2, TKS_U16));
  expectSameSamples(readHeights(file + ":4x2:i8"),
                    heightsFrom<int8_t>({1, 0, 2, 0, 0, 1, -1, -1}, 4, TKS_I8));
}

TEST_F(HeightFiles, HeightsThatAreNoneAreRefused) {
  const std::string six = save("six.raw", std::vector<uint8_t>(6));
  const std::string square = save("six.hgt", std::vector<uint8_t>(6));
  const std::string text = save("text.tif", std::vector<char>{'h', 'e', 'l', 'l', 'o'});
  const std::string empty = save("empty.tif", std::vector<char>{});
  const ImageFile rgb{2, 2, 3, TKS_U8, std::vector<std::byte>(12)};
  ASSERT_TRUE(writeImage(path("rgb.png"), rgb).ok());
  const ImageFile grey_alpha{2, 2, 2, TKS_U8, std::vector<std::byte>(8)};
  ASSERT_TRUE(writeImage(path("alpha.png"), grey_alpha).ok());
  const std::tuple<std::string, tks_status> refused[] = {{six, TKS_USAGE},
                                                         {six + ":2x2:u8", TKS_USAGE},
                                                         {six + ":2x3:u16", TKS_USAGE},
                                                         {six + ":0x0:u8", TKS_USAGE},
                                                         {square, TKS_IO},
                                                         {text, TKS_IO},
                                                         {empty, TKS_IO},
                                                         {path("missing.tif"), TKS_IO},
                                                         {path("missing.hgt"), TKS_IO},
                                                         {path(""), TKS_IO},
                                                         {path("missing.raw:2x2:u8"), TKS_IO},
                                                         {path("rgb.png"), TKS_USAGE},
                                                         {path("alpha.png"), TKS_USAGE}};
  for (const auto& [file, code] : refused) {
    const auto read = readHeights(file);
    EXPECT_EQ(read.status().code(), code) << file << ": " << read.status().message();
    EXPECT_FALSE(read.status().message().empty());
  }
}

TEST_F(HeightFiles, TruncatedFilesFail) {
  const HeightFile heights = randomHeights({64, 64}, TKS_U16);
  for (const char* format : {"tif", "png"}) {
    ASSERT_TRUE(writeHeights(path("a"), heights, format).ok());
    const auto size = std::filesystem::file_size(path("a"));
    for (const double part : {0.1, 0.5, 0.9}) {
      std::filesystem::copy_file(path("a"), path("b"),
                                 std::filesystem::copy_options::overwrite_existing);
      std::filesystem::resize_file(path("b"), static_cast<uintmax_t>(double(size) * part));
      EXPECT_EQ(readHeights(path("b")).status().code(), TKS_IO) << format << " " << part;
    }
  }
}

TEST_F(HeightFiles, WhatCannotBeWrittenFails) {
  const HeightFile heights = randomHeights({4, 3}, TKS_I16);
  EXPECT_EQ(writeHeights(path("a.hgt"), heights).code(), TKS_USAGE);  // not square
  EXPECT_EQ(writeHeights(path("a.xyz"), heights).code(), TKS_USAGE);
  EXPECT_EQ(writeHeights(path("missing/a.tif"), heights).code(), TKS_IO);
  EXPECT_EQ(writeHeights(path("missing/a.raw"), heights).code(), TKS_IO);
  HeightFile short_of_data = heights;
  short_of_data.data.pop_back();
  EXPECT_EQ(writeHeights(path("a.tif"), short_of_data).code(), TKS_USAGE);
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_EQ(writeHeights("/dev/full", heights, "tif").code(), TKS_IO);
    EXPECT_EQ(writeHeights("/dev/full", heights, "raw").code(), TKS_IO);
  }
}

TEST_F(HeightFiles, StandardInputIsRead) {
  const HeightFile heights = randomHeights({9, 5}, TKS_F32);
  ASSERT_TRUE(writeHeights(path("a.tif"), heights).ok());
  ASSERT_NE(std::freopen(path("a.tif").c_str(), "rb", stdin), nullptr);
  expectSameSamples(readHeights("-"), heights);
  EXPECT_EQ(readHeights("-").status().code(), TKS_IO);  // nothing left
  ASSERT_TRUE(writeHeights(path("a.raw"), heights).ok());
  ASSERT_NE(std::freopen(path("a.raw").c_str(), "rb", stdin), nullptr);
  expectSameSamples(readHeights("-:9x5:f32"), heights);
}

}  // namespace
}  // namespace tetrakis::tools
