// SPDX-License-Identifier: Apache-2.0
// Voids through the command line: what a file declares, what --nodata says, and what comes back.
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "tests/cli/cli_fixture.hpp"
#include "tests/support/tiny_tiff.hpp"

namespace tetrakis::test {
namespace {

class CliVoids : public CliTest {
 protected:
  /// Hills whose first 40 samples hold `value`.
  static tools::HeightFile holed(uint16_t value) {
    tools::HeightFile heights = hills(17);
    for (size_t i = 0; i < 40; ++i) std::memcpy(heights.data.data() + 2 * i, &value, sizeof value);
    return heights;
  }
};

TEST_F(CliVoids, DeclaredNodataComesBackDeclared) {
  tools::HeightFile heights = holed(65535);
  heights.nodata = 65535;
  ASSERT_TRUE(tools::writeHeights(path("v.tif"), heights).ok());
  const Outcome run = cli("encode v.tif --lossless -o v.tks");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("40 samples are void"), std::string::npos) << run.err;
  ASSERT_EQ(cli("decode v.tks --height w.tif").code, 0);
  const auto decoded = tools::readHeights(path("w.tif"));
  ASSERT_TRUE(decoded.ok());
  EXPECT_TRUE(sameBytes(decoded->data, heights.data));
  EXPECT_EQ(decoded->nodata, 65535);
}

/// A mask in the file leaves samples out of floats as well, and then NaN has to be declared.
TEST_F(CliVoids, UndeclaredNanStaysUndeclared) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> samples{1, 2, 3, 4, kNone, 6, kNone, 8};
  const auto bytes = std::as_bytes(std::span(samples));
  tools::HeightFile heights;
  heights.width = 4;
  heights.height = 2;
  heights.sample = TKS_F32;
  heights.data.assign(bytes.begin(), bytes.end());
  for (const bool declared : {false, true}) {
    heights.nodata = declared ? std::optional(double{kNone}) : std::nullopt;
    ASSERT_TRUE(tools::writeHeights(path("v.tif"), heights).ok());
    ASSERT_EQ(cli("-q encode v.tif --lossless -f -o v.tks").code, 0);
    ASSERT_EQ(cli("-q decode v.tks -f --height w.tif").code, 0);
    const auto decoded = tools::readHeights(path("w.tif"));
    ASSERT_TRUE(decoded.ok());
    EXPECT_TRUE(sameBytes(decoded->data, heights.data));
    EXPECT_EQ(decoded->nodata.has_value(), declared);
    const std::string table = cli("info v.tks").out, text = cli("info --json v.tks").out;
    EXPECT_NE(text.find(declared ? "\"nodata\": \"nan\"" : "\"nodata\": null"), text.npos) << text;
    const size_t row = table.find("heights.nodata");
    ASSERT_NE(row, table.npos);
    EXPECT_EQ(table.substr(row, table.find('\n', row) - row).ends_with(declared ? " nan" : " -"),
              true);
  }
  TinyTiff tiff(32, 32, 1, 32, std::vector<uint8_t>(32 * 32 * 4, 0x40));  // 3.0039
  tiff.shorts(TinyTiff::kSampleFormat, {3});
  TinyTiff mask(32, 32, 1, 1, std::vector<uint8_t>(32 * 4, 0xF0));
  mask.longs(TinyTiff::kSubfileType, {4});
  tiff.addPage(mask);
  const std::vector<uint8_t> file = tiff.bytes();
  write("masked.tif", {file.begin(), file.end()});
  ASSERT_EQ(cli("-q encode masked.tif --lossless -f -o v.tks").code, 0);
  ASSERT_EQ(cli("-q decode v.tks -f --height w.tif").code, 0);
  const auto masked = tools::readHeights(path("w.tif"));
  ASSERT_TRUE(masked.ok() && masked->nodata);
  EXPECT_TRUE(std::isnan(*masked->nodata));
}

/// The text of a nodata value and the samples seldom agree to the last bit.
TEST_F(CliVoids, NodataIsMetAsGdalMeetsIt) {
  tools::HeightFile heights = hills(17);
  heights.sample = TKS_F32;
  heights.data.assign(17 * 17 * sizeof(float), {});
  for (size_t i = 0; i < 17 * 17; ++i) {
    const float sample = i < 20 ? -3.40282306e+38F : i < 40 ? -3.40282347e+38F : float(i % 90);
    std::memcpy(heights.data.data() + 4 * i, &sample, sizeof sample);
  }
  ASSERT_TRUE(tools::writeHeights(path("plain.tif"), heights).ok());
  heights.nodata = -3.4028234663852886e+38;
  ASSERT_TRUE(tools::writeHeights(path("declared.tif"), heights).ok());
  // Five samples times 0.1 are 0.5 and, in doubles, a trifle more.
  const std::string target = " --max-error 0.5 -o v.tks -f";
  const Outcome declared = cli("encode declared.tif" + target);
  EXPECT_NE(declared.err.find("40 samples are void"), std::string::npos) << declared.err;
  EXPECT_EQ(cli("compare v.tks --height declared.tif").code, 0);
  const Outcome plain = cli("encode plain.tif --lossless -o p.tks");
  EXPECT_NE(plain.err.find("--nodata -3.4028235e+38"), std::string::npos) << plain.err;
  EXPECT_EQ(cli("encode plain.tif --lossless -o q.tks -q").err, "");
  const Outcome given = cli("encode plain.tif --nodata -3.4028235e+38" + target);
  EXPECT_NE(given.err.find("note: 40 samples are void"), std::string::npos) << given.err;
  EXPECT_EQ(given.err.find("--nodata"), std::string::npos) << given.err;
  EXPECT_EQ(cli("compare v.tks --height plain.tif").code, 0);
}

TEST_F(CliVoids, MasksOfPagesAreVoids) {
  TinyTiff tiff(32, 32, 1, 8, std::vector<uint8_t>(32 * 32, 7));
  TinyTiff mask(32, 32, 1, 1, std::vector<uint8_t>(32 * 4, 0xF0));  // every other four
  mask.longs(TinyTiff::kSubfileType, {4});
  tiff.addPage(mask);
  const std::vector<uint8_t> bytes = tiff.bytes();
  write("m.tif", {bytes.begin(), bytes.end()});
  for (const char* nodata : {"", " --nodata 9"}) {
    const Outcome run = cli("encode m.tif --lossless -f -o m.tks" + std::string(nodata));
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("512 samples are void"), std::string::npos) << run.err;
    EXPECT_EQ(cli("compare m.tks --height m.tif").code, 0);
  }
}

/// 1 m is 3.28 survey feet: a bound of 1 ft would take more bytes.
TEST_F(CliVoids, BoundsInMetresHoldForHeightsInFeet) {
  TinyTiff tiff(32, 32, 1, 8, std::vector<uint8_t>(32 * 32, 7));
  tiff.shorts(34735, {1, 1, 1, 3, 1024, 0, 1, 1, 3072, 0, 1, 2227, 4096, 0, 1, 6360});
  const std::vector<uint8_t> bytes = tiff.bytes();
  write("feet.tif", {bytes.begin(), bytes.end()});
  ASSERT_EQ(cli("encode feet.tif --max-error 1m -o f.tks").code, 0);
  const std::string info = cli("info f.tks").out;
  EXPECT_NE(info.find("us-ft"), std::string::npos) << info;
  EXPECT_NE(info.find("3.2808333333333"), std::string::npos) << info;
}

/// They are so nearly the same length that heights and texture are ordered alike.
TEST_F(CliVoids, SurveyFeetAreWorthAsMuchAsFeet) {
  makeInputs();
  std::string payloads[2];
  for (const char* unit : {"ft", "US_survey_foot"}) {
    const std::string encode = "encode height.tif --texture texture.png --lossless -f -o u.tks";
    ASSERT_EQ(cli(encode + " --unit " + unit).code, 0);
    const std::string info = cli("info u.tks").out;
    const size_t header = std::stoul(info.substr(info.find("header_bytes") + 12));
    payloads[unit[0] == 'U'] = content("u.tks").substr(header);
    EXPECT_EQ(info.find("us-ft") != info.npos, unit[0] == 'U') << info;
  }
  EXPECT_EQ(payloads[0], payloads[1]);
}

TEST_F(CliVoids, OptionDeclaresThemForAnyFormat) {
  ASSERT_TRUE(tools::writeHeights(path("v.png"), holed(9)).ok());
  ASSERT_EQ(cli("encode v.png --nodata 9 --max-error 2 -o v.tks").code, 0);
  ASSERT_EQ(cli("decode v.tks --height w.png").code, 0);
  const auto decoded = tools::readHeights(path("w.png"));
  ASSERT_TRUE(decoded.ok());
  for (size_t i = 0; i < decoded->data.size() / 2; ++i) {
    uint16_t sample = 0;
    std::memcpy(&sample, decoded->data.data() + 2 * i, sizeof sample);
    EXPECT_EQ(sample == 9, i < 40) << i;
  }
  EXPECT_EQ(cli("compare v.tks --height v.png").code, 0) << "the bound holds for valid samples";
}

TEST_F(CliVoids, WhatLeavesNoTriangleIsTold) {
  write("a.raw", std::string({0, 0, 7, 0, 0, 0, 7, 0}));  // every other sample
  ASSERT_EQ(cli("encode a.raw:2x2:i16 --nodata 0 --lossless -o a.tks").code, 0);
  for (const char* mesh : {"a.glb", "a.ply --triangles 9", "a.obj --coded-mesh"}) {
    const Outcome run = cli(std::string("decode a.tks --mesh ") + mesh);
    EXPECT_EQ(run.code, 1);
    EXPECT_NE(run.err.find("voids"), std::string::npos) << run.err;
  }
}

}  // namespace
}  // namespace tetrakis::test
