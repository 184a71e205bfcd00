// SPDX-License-Identifier: Apache-2.0
// Which samples of a height file are void: nodata as GDAL compares it, masks, and what only looks
// like nodata. And which samples are taken at all.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "apps/tools/files/files.hpp"
#include "tests/support/same_bytes.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/tiny_tiff.hpp"

namespace tetrakis::tools {
namespace {

using test::ScratchFolder;
using test::TinyTiff;

constexpr float kLowest = std::numeric_limits<float>::lowest();

class HeightVoids : public ScratchFolder {
 protected:
  Notes notes;

  /// One row of samples, three times.
  template <class T>
  static TinyTiff tiffOf(const std::vector<T>& row) {
    std::vector<uint8_t> pixels(3 * row.size() * sizeof(T));
    for (size_t y = 0; y < 3; ++y)
      std::memcpy(pixels.data() + y * row.size() * sizeof(T), row.data(), row.size() * sizeof(T));
    TinyTiff tiff(static_cast<uint32_t>(row.size()), 3, 1, 8 * sizeof(T), pixels);
    const uint16_t format = std::is_floating_point_v<T> ? 3 : std::is_signed_v<T> ? 2 : 1;
    tiff.shorts(TinyTiff::kSampleFormat, {format});
    return tiff;
  }

  Result<HeightFile> read(const TinyTiff& tiff, std::optional<double> nodata = {}) {
    notes.clear();
    return readHeights(save("a.tif", tiff.bytes()), nodata, &notes);
  }

  template <class T>
  static std::vector<T> samplesOf(const HeightFile& heights) {
    std::vector<T> samples(heights.data.size() / sizeof(T));
    std::memcpy(samples.data(), heights.data.data(), heights.data.size());
    return samples;
  }

  /// A mask page, 255 for valid samples, or of single bits.
  static TinyTiff maskOf(const std::vector<bool>& valid, uint32_t width, uint16_t bits) {
    const auto height = static_cast<uint32_t>(valid.size()) / width;
    const size_t row_bytes = (width * bits + 7) / 8;
    std::vector<uint8_t> pixels(row_bytes * height);
    for (size_t i = 0; i < valid.size(); ++i) {
      if (!valid[i]) continue;
      const size_t x = i % width, y = i / width;
      if (bits == 8) pixels[y * row_bytes + x] = 255;
      if (bits == 1) pixels[y * row_bytes + x / 8] |= static_cast<uint8_t>(128 >> x % 8);
    }
    TinyTiff mask(width, height, 1, bits, pixels);
    mask.longs(TinyTiff::kSubfileType, {4});
    mask.shorts(TinyTiff::kPhotometric, {4});
    return mask;
  }

  /// 11 x 3 samples, of which a third is not valid.
  static std::vector<bool> pattern() {
    std::vector<bool> valid(33);
    for (size_t i = 0; i < valid.size(); ++i) valid[i] = i % 3 != 1;
    return valid;
  }
};

TEST_F(HeightVoids, FloatsThatGdalTakesForNodataBecomeIt) {
  TinyTiff tiff = tiffOf<float>({1, -3.40282306e+38F, kLowest, -1e30F, 0, -9999, -9998.9F});
  for (const char* text : {"-3.4028234663852886e+38", "-3.40282306e+38", "-3.4028235e+38",
                           "-3.40282347e+38", "-3.4028236e+38", "-3.40282e+38"}) {
    tiff.ascii(TinyTiff::kGdalNodata, text);
    const auto heights = read(tiff);
    ASSERT_TRUE(heights.ok() && heights->nodata) << text;
    const auto samples = samplesOf<float>(*heights);
    EXPECT_EQ(samples[1], *heights->nodata) << text;
    EXPECT_EQ(samples[2], *heights->nodata) << text;
    EXPECT_EQ(samples[3], -1e30F) << text;
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].text.find("at -1e+30: if they are void"), std::string::npos)
        << notes[0].text;
  }
  const auto given = read(tiff, -9999.0001);
  ASSERT_TRUE(given.ok());
  EXPECT_EQ(samplesOf<float>(*given)[5], static_cast<float>(-9999.0001));
  EXPECT_EQ(*given->nodata, double{static_cast<float>(-9999.0001)});
  EXPECT_EQ(samplesOf<float>(*given)[6], -9998.9F);
}

/// Floats are compared with the nearest float, as GDAL does.
TEST_F(HeightVoids, NodataOfFloatsIsTheNearestFloat) {
  struct Case {
    const char* text;
    double nodata;
  };
  TinyTiff tiff = tiffOf<float>({1, kLowest, 0, -0.0F, 1e-42F, 5});
  for (const auto& [text, nodata] :
       {Case{"-1.7976931348623157e+308", -HUGE_VAL}, Case{"1e300", HUGE_VAL},
        Case{"2.2250738585072014e-308", 0}, Case{"1e-42", double{1e-42F}}, Case{"-0", 0},
        Case{"0.1", double{0.1F}}}) {
    tiff.ascii(TinyTiff::kGdalNodata, text);
    const auto heights = read(tiff);
    ASSERT_TRUE(heights.ok() && heights->nodata) << text;
    EXPECT_EQ(*heights->nodata, nodata) << text;
    const auto samples = samplesOf<float>(*heights);
    EXPECT_EQ(std::vector(samples.begin(), samples.begin() + 6),
              (std::vector<float>{1, kLowest, 0, 0, 1e-42F, 5}));
  }
}

TEST_F(HeightVoids, NumbersThatFilesWriteWithoutAHeightAreVoid) {
  const auto expectVoid = [this](const TinyTiff& tiff, double value, const std::string& said) {
    const auto heights = read(tiff);
    ASSERT_TRUE(heights.ok() && heights->nodata) << value;
    EXPECT_EQ(*heights->nodata, value);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].text.find(said), std::string::npos) << notes[0].text;
    const auto kept = read(tiff, std::numeric_limits<double>::quiet_NaN());
    ASSERT_TRUE(kept.ok());
    EXPECT_TRUE(std::isnan(*kept->nodata));
    EXPECT_EQ(kept->data, heights->data);
  };
  expectVoid(tiffOf<float>({1, kLowest, 7, kLowest, 3}), kLowest, "6 samples are -3.4028235e+38,");
  expectVoid(tiffOf<float>({1, 2, -9999, 1500}), -9999, "3 samples are -9999,");
  expectVoid(tiffOf<float>({1, 2, -32767, 15}), -32767, "-32767");
  expectVoid(tiffOf<int16_t>({-400, 8848, -9999, 3}), -9999, "-9999");
  expectVoid(tiffOf<int16_t>({-400, 8848, -32768, 3}), -32768, "-32768");
  expectVoid(tiffOf<int32_t>({0, 50000, -999999, 3}), -999999, "-999999");
}

TEST_F(HeightVoids, OtherNumbersStayHeights) {
  for (const auto& row : std::vector<std::vector<float>>{{1, kLowest, 2e30F, 3},  // several values
                                                         {kLowest, kLowest, kLowest},
                                                         {1, 2, -9998, 1500},
                                                         {1, 2, 9999, 1500},
                                                         {1, 2, -99, 10},
                                                         {3, 3, -9999, 3},  // two values
                                                         {-10900, 10, -9999, 3}}) {
    EXPECT_FALSE(read(tiffOf(row))->nodata) << row[0] << ' ' << row[2];
  }
}

TEST_F(HeightVoids, NodataInWordsOfOldLibrariesIsNoNumber) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  TinyTiff tiff = tiffOf<float>({0, -1, nan, 1});
  for (const char* text :
       {"nan", "-nan", "-1.#IND", "1.#QNAN", "1.#QNAN00", "-1.#IND00", "1.#SNAN"}) {
    tiff.ascii(TinyTiff::kGdalNodata, text);
    const auto heights = read(tiff);
    ASSERT_TRUE(heights.ok());
    ASSERT_TRUE(heights->nodata) << text;
    EXPECT_TRUE(std::isnan(*heights->nodata)) << text;
    EXPECT_TRUE(notes.empty()) << text;
  }
  tiff.ascii(TinyTiff::kGdalNodata, "-1.#INF");
  EXPECT_EQ(read(tiff)->nodata, -HUGE_VAL);
  tiff.ascii(TinyTiff::kGdalNodata, " -1 \n");
  EXPECT_EQ(read(tiff)->nodata, -1);
  for (const char* text : {"-1 m", "1.#", "1,5", "none"}) {
    tiff.ascii(TinyTiff::kGdalNodata, text);
    EXPECT_FALSE(read(tiff)->nodata) << text;
    ASSERT_FALSE(notes.empty()) << text;
    EXPECT_NE(notes[0].text.find("--nodata"), std::string::npos) << text;
  }
}

TEST_F(HeightVoids, SamplesFarFromNodataKeepTheirBits) {
  std::mt19937 random(3);
  std::vector<float> row(3000);
  for (float& sample : row) sample = static_cast<float>(random() % 100000) * 0.01F;
  row[7] = -0.0F;
  for (const char* text : {"-9999", "0", "nan", "inf", "1e30"}) {
    TinyTiff tiff = tiffOf(row);
    tiff.ascii(TinyTiff::kGdalNodata, text);
    const auto heights = read(tiff);
    ASSERT_TRUE(heights.ok());
    EXPECT_EQ(std::memcmp(heights->data.data(), row.data(), row.size() * sizeof(float)), 0) << text;
  }
}

TEST_F(HeightVoids, MasksBecomeTheDeclaredNodataValue) {
  for (const uint16_t bits : {uint16_t{1}, uint16_t{8}}) {
    TinyTiff tiff = tiffOf<int16_t>({5, 4, 3, 2, 1, 0, -1, -2, -3, -4, -5});
    tiff.addPage(maskOf(pattern(), 11, bits));
    tiff.ascii(TinyTiff::kGdalNodata, "-999");
    for (const std::optional<double> given : {std::optional<double>(), std::optional(-77.0)}) {
      const auto heights = read(tiff, given);
      ASSERT_TRUE(heights.ok()) << heights.status().message();
      const double nodata = given.value_or(-999);
      EXPECT_EQ(heights->nodata, nodata);
      const auto samples = samplesOf<int16_t>(*heights);
      for (size_t i = 0; i < samples.size(); ++i)
        EXPECT_EQ(samples[i], pattern()[i] ? 5 - int(i % 11) : nodata) << i;
      EXPECT_TRUE(notes.empty());
    }
  }
}

TEST_F(HeightVoids, MasksNeedNoDeclaredValue) {
  TinyTiff floats = tiffOf<float>({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  floats.addPage(maskOf(pattern(), 11, 8));
  const auto heights = read(floats);
  ASSERT_TRUE(heights.ok());
  const auto samples = samplesOf<float>(*heights);
  for (size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(std::isnan(samples[i]), !pattern()[i]);

  TinyTiff integers = tiffOf<uint8_t>({255, 254, 253, 3, 4, 5, 6, 7, 8, 9, 10});
  integers.addPage(maskOf(pattern(), 11, 1));
  const auto chosen = read(integers);
  ASSERT_TRUE(chosen.ok() && chosen->nodata);
  EXPECT_EQ(*chosen->nodata, 252);
  const auto bytes = samplesOf<uint8_t>(*chosen);
  for (size_t i = 0; i < bytes.size(); ++i) EXPECT_EQ(bytes[i] == 252, !pattern()[i]) << i;
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].text.find("252"), std::string::npos);
}

TEST_F(HeightVoids, MasksOfSamplesThatTakeAllValuesAreRefused) {
  std::vector<uint8_t> row(257);
  for (size_t i = 0; i < row.size(); ++i) row[i] = static_cast<uint8_t>(i);
  std::vector<bool> valid(3 * row.size(), true);
  valid[0] = false;
  TinyTiff tiff = tiffOf(row);
  tiff.addPage(maskOf(valid, 257, 8));
  const auto heights = read(tiff);
  EXPECT_EQ(heights.status().code(), TKS_USAGE);
  EXPECT_NE(heights.status().message().find("take all"), std::string::npos)
      << heights.status().message();
}

TEST_F(HeightVoids, MasksBesideTheFileCount) {
  const TinyTiff tiff = tiffOf<float>({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  TinyTiff mask = maskOf(pattern(), 11, 8);
  mask.remove(TinyTiff::kSubfileType);
  mask.shorts(TinyTiff::kPhotometric, {1});
  save("a.tif.msk", mask.bytes());
  const auto heights = read(tiff);
  ASSERT_TRUE(heights.ok()) << heights.status().message();
  EXPECT_TRUE(std::isnan(samplesOf<float>(*heights)[1]));
  EXPECT_EQ(samplesOf<float>(*heights)[2], 2);
  save("a.tif.msk", maskOf({true, false}, 2, 8).bytes());
  EXPECT_EQ(read(tiff).status().code(), TKS_USAGE);
  save("a.tif.msk", std::vector<char>{'n', 'o'});
  EXPECT_EQ(read(tiff).status().code(), TKS_IO);
}

TEST_F(HeightVoids, FurtherPagesAreNotedButNotMasksAndOverviews) {
  TinyTiff tiff = tiffOf<float>({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
  TinyTiff overview = tiffOf<float>({0, 1});
  overview.longs(TinyTiff::kSubfileType, {1});
  TinyTiff overview_mask = maskOf({true, true}, 2, 8);
  overview_mask.longs(TinyTiff::kSubfileType, {5});
  tiff.addPage(overview);
  tiff.addPage(maskOf(pattern(), 11, 8));
  tiff.addPage(overview_mask);
  ASSERT_TRUE(read(tiff).ok());
  EXPECT_TRUE(notes.empty());
  tiff.addPage(tiffOf<float>({0, 1}));
  ASSERT_TRUE(read(tiff).ok());
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].text.find("first page"), std::string::npos);
}

TEST_F(HeightVoids, IsolatedValuesAreNotedUnlessDeclared) {
  const auto expectNote = [this](TinyTiff tiff, const std::string& value) {
    ASSERT_TRUE(read(tiff).ok());
    ASSERT_EQ(notes.size(), 1U) << value;
    EXPECT_NE(notes[0].text.find(value + ": if"), std::string::npos) << notes[0].text;
    ASSERT_TRUE(read(tiff, std::numeric_limits<double>::quiet_NaN()).ok());
    EXPECT_TRUE(notes.empty());
    tiff.ascii(TinyTiff::kGdalNodata, value);
    ASSERT_TRUE(read(tiff).ok());
    for (const Note& note : notes)  // beside it others may be isolated
      EXPECT_EQ(note.text.find("at " + value), std::string::npos) << note.text;
  };
  expectNote(tiffOf<float>({1, 2, kLowest, 3, 1e32F}), "-3.4028235e+38");
  expectNote(tiffOf<float>({1, 2, 1e33F, 3, 2e30F}), "1e+33");
  expectNote(tiffOf<uint16_t>({0, 9000, 65535, 3}), "65535");
  expectNote(tiffOf<float>({1, 2, 1e9F}), "1e+09");
  expectNote(tiffOf<int16_t>({-400, 8848, -9999, std::numeric_limits<int16_t>::max()}), "32767");
  expectNote(tiffOf<uint16_t>({0, 900, 9999, 3}), "9999");
  expectNote(tiffOf<int16_t>({-400, 4848, 30000, 3}), "30000");
  expectNote(tiffOf<uint16_t>({0, 40000, 40010}), "0");
  expectNote(tiffOf<float>({0, 400, 500}), "0");
  for (const TinyTiff& usual :
       {tiffOf<float>({1, 2, 1e9F, 1.1e9F}), tiffOf<float>({0, 5, 9, 16}), tiffOf<float>({7, 90}),
        tiffOf<int16_t>({-5000, 0, 5000}), tiffOf<int16_t>({-32768, -10000, 5000, 20000}),
        tiffOf<uint16_t>({65535, 65535}), tiffOf<uint16_t>({65535, 65534, 50000, 40000}),
        tiffOf<uint8_t>({0, 1, 255})}) {
    ASSERT_TRUE(read(usual).ok());
    EXPECT_TRUE(notes.empty());
  }
}

TEST_F(HeightVoids, DoublesThatAreFloatsAreTaken) {
  using Limits = std::numeric_limits<double>;
  TinyTiff tiff = tiffOf<double>({0.25, -0.0, double{kLowest}, 1e-40F, Limits::quiet_NaN()});
  const auto heights = read(tiff, Limits::quiet_NaN());
  ASSERT_TRUE(heights.ok()) << heights.status().message();
  EXPECT_EQ(heights->sample, TKS_F32);
  const auto samples = samplesOf<float>(*heights);
  EXPECT_EQ(samples[0], 0.25F);
  EXPECT_TRUE(samples[1] == 0 && std::signbit(samples[1]));
  EXPECT_EQ(samples[2], kLowest);
  EXPECT_EQ(samples[3], 1e-40F);
  EXPECT_TRUE(std::isnan(samples[4]));
  EXPECT_EQ(heights->rounding, 0);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes[0].text.find("hold them exactly"), std::string::npos);
  for (const double odd : {0.1, Limits::denorm_min(), 16777217.0, 0.1}) {
    const auto rounded = read(tiffOf<double>({1, odd}));
    ASSERT_TRUE(rounded.ok());
    EXPECT_EQ(rounded->rounding, std::abs(odd - double{static_cast<float>(odd)}));
    EXPECT_NE(notes.at(0).text.find("rounded to 32 bits"), std::string::npos);
  }
  EXPECT_EQ(read(tiffOf<double>({1, 1e300})).status().code(), TKS_USAGE);
}

TEST_F(HeightVoids, NodataOfDoublesNeedNotBeAFloat) {
  for (const double nodata : {std::numeric_limits<double>::lowest(), -3.4e38, -9999.1, -9999.0}) {
    TinyTiff tiff = tiffOf<double>({1, nodata, 3});
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", nodata);
    tiff.ascii(TinyTiff::kGdalNodata, text);
    const auto heights = read(tiff);
    ASSERT_TRUE(heights.ok()) << heights.status().message();
    const float sample = samplesOf<float>(*heights)[1];
    EXPECT_TRUE(std::isnan(sample) || double{sample} == heights->nodata) << nodata;
    EXPECT_EQ(samplesOf<float>(*heights)[2], 3);
  }
}

/// Whatever the nodata value of doubles is, the same samples are void among floats, and no others.
TEST_F(HeightVoids, NoHeightOfDoublesBecomesVoid) {
  using Limits = std::numeric_limits<double>;
  const std::vector<double> numbers = {
      0,   -0.0, Limits::min(), Limits::denorm_min(), 1e-42, 1.0001e-42, 1e-45,  1e-300,
      0.1, 0.3,  -9999,         -9999.0034,           1e10,  3e38,       kLowest};
  std::vector<double> nodatas = numbers;
  for (const double value : {Limits::lowest(), Limits::max(), 1e300, HUGE_VAL, Limits::quiet_NaN()})
    nodatas.push_back(value);
  for (const double nodata : nodatas) {
    std::vector<double> row = numbers;
    row.push_back(nodata);
    const auto heights = read(tiffOf(row), nodata);
    ASSERT_TRUE(heights.ok()) << nodata << ' ' << heights.status().message();
    ASSERT_TRUE(heights->nodata);
    const double kept = *heights->nodata;
    const auto samples = samplesOf<float>(*heights);
    for (size_t i = 0; i < row.size(); ++i) {
      const bool is_void = std::abs(row[i] - nodata) < 2.4e-7 * std::abs(row[i] + nodata) ||
                           row[i] == nodata || std::isnan(row[i]);
      EXPECT_EQ(std::isnan(samples[i]) || samples[i] == kept, is_void) << nodata << ' ' << row[i];
      if (!is_void) {
        EXPECT_EQ(samples[i], static_cast<float>(row[i]));
      }
    }
    const bool told = std::any_of(notes.begin(), notes.end(), [](const Note& note) {
      return note.text.starts_with("floats of 32 bits do not hold its nodata value");
    });
    EXPECT_EQ(told, !(std::isnan(kept) && std::isnan(nodata)) &&
                        !(std::abs(kept - nodata) <= 2.4e-7 * std::abs(kept + nodata)) &&
                        kept != nodata)
        << nodata;
  }
}

/// What a mask leaves out may be any number, and counts in no rounding.
TEST_F(HeightVoids, MaskedDoublesNeedNotBeFloats) {
  TinyTiff tiff = tiffOf<double>({1, 1e300, 2, 3, 0.1, 4, 5, HUGE_VAL, 6, 7, 0.3});
  tiff.addPage(maskOf({true, false, true, true, false, true, true, false, true, true, false,
                       true, false, true, true, false, true, true, false, true, true, false,
                       true, false, true, true, false, true, true, false, true, true, false},
                      11, 8));
  const auto heights = read(tiff);
  ASSERT_TRUE(heights.ok()) << heights.status().message();
  EXPECT_EQ(heights->rounding, 0);
  EXPECT_TRUE(std::isnan(*heights->nodata));
  EXPECT_TRUE(std::isnan(samplesOf<float>(*heights)[1]));
  EXPECT_EQ(samplesOf<float>(*heights)[3], 3);
}

TEST_F(HeightVoids, VoidsOfAnotherNumberThanDeclaredAreNoted) {
  const auto expectNote = [this](TinyTiff tiff, const char* declared, const std::string& said) {
    tiff.ascii(TinyTiff::kGdalNodata, declared);
    const auto heights = read(tiff);
    ASSERT_TRUE(heights.ok() && heights->nodata);
    ASSERT_EQ(notes.size(), 1U) << declared;
    EXPECT_EQ(notes[0].option, "--nodata");
    EXPECT_NE(notes[0].text.find(said), std::string::npos) << notes[0].text;
  };
  expectNote(tiffOf<int16_t>({-400, 8848, -32768, 3}), "-32767",
             "3 samples lie far from all others and from its nodata value -32767, at -32768: if "
             "void, give --nodata -32768");
  expectNote(tiffOf<float>({1, 2, -9999, 1500}), "-32768", "give --nodata -9999");
  expectNote(tiffOf<float>({1, 2, kLowest, 1500}), "-9999", "give --nodata -3.4028235e+38");
  expectNote(tiffOf<float>({1, 2, -9999, 1500}), "nan", "give --nodata -9999");
  expectNote(tiffOf<float>({1, 2, -9999, 1500, -32768}), "-32768", "only a mask can say so");
  ASSERT_TRUE(read(tiffOf<float>({1, 2, -9999, 1500}), std::nan("")).ok());
  EXPECT_TRUE(notes.empty()) << "all are heights, as their user says";
}

TEST_F(HeightVoids, NodataThatNoSampleCanHaveIsNoted) {
  TinyTiff tiff = tiffOf<int16_t>({0, -9999, 9999});
  for (const char* text : {"-9999.4", "70000", "nan", "-9999"}) {
    tiff.ascii(TinyTiff::kGdalNodata, text);
    ASSERT_TRUE(read(tiff).ok());
    if (std::string(text) == "-9999") {
      EXPECT_TRUE(notes.empty());
      continue;
    }
    ASSERT_FALSE(notes.empty()) << text;
    EXPECT_EQ(notes[0].text, "no sample of its type can have the nodata value " +
                                 std::string(text) + ", which makes nothing void");
  }
  tiff.ascii(TinyTiff::kGdalNodata, "-9999");
  ASSERT_TRUE(read(tiff, 0.5).ok());
  EXPECT_EQ(notes.size(), 1U) << "a slip of the pen";
  ASSERT_TRUE(read(tiff, std::numeric_limits<double>::quiet_NaN()).ok());
  EXPECT_TRUE(notes.empty()) << "what is none on purpose";
}

TEST_F(HeightVoids, UnitsOfGdalGetOneName) {
  TinyTiff tiff = tiffOf<float>({1, 2});
  tiff.ascii(TinyTiff::kGdalMetadata,
             "<GDALMetadata><Item name=\"UNITTYPE\" sample=\"0\" role=\"unittype\">US survey foot"
             "</Item></GDALMetadata>");
  EXPECT_EQ(read(tiff)->unit, "us-ft");
}

/// OpenImageIO would shift signed samples, and stretch those of 12 bits. What the header of the
/// codestream says is what is read.
TEST_F(HeightVoids, Jpeg2000IsReadAsItsHeaderSays) {
  for (const tks_sample sample : {TKS_U8, TKS_U16}) {
    ImageFile image{40, 40, 1, sample, {}};
    std::mt19937 random(5);
    image.data.resize(40 * 40 * tks_sample_bytes(sample));
    for (std::byte& byte : image.data) byte = static_cast<std::byte>(random());
    ASSERT_TRUE(writeImage(path("a.jp2"), image).ok());
    const auto heights = readHeights(path("a.jp2"));
    ASSERT_TRUE(heights.ok()) << heights.status().message();
    EXPECT_EQ(heights->sample, sample);
    EXPECT_TRUE(test::sameBytes(heights->data, image.data));
    std::ifstream file(path("a.jp2"), std::ios::binary);
    std::string bytes(std::istreambuf_iterator<char>(file), {});
    const size_t depth = bytes.find("\xFF\x4F\xFF\x51") + 42;
    const tks_sample as_signed = sample == TKS_U8 ? TKS_I8 : TKS_I16;
    for (const auto& [odd, wanted] :
         {std::pair{char(0x80 | bytes[depth]), as_signed}, {char(11), TKS_U16}}) {
      std::string changed = bytes;
      changed[depth] = odd;
      const auto read = readHeights(save("b.jp2", std::vector(changed.begin(), changed.end())));
      ASSERT_TRUE(read.ok()) << read.status().message();
      EXPECT_EQ(read->sample, wanted);
    }
    bytes[depth + 1] = 2;  // a coarser grid
    const auto refused = readHeights(save("c.jp2", std::vector(bytes.begin(), bytes.end())));
    EXPECT_EQ(refused.status().code(), TKS_USAGE) << refused.status().message();
    const std::vector<char> cut(bytes.begin(), bytes.begin() + ptrdiff_t(bytes.size() / 2));
    EXPECT_NE(readHeights(save("d.jp2", cut)).status().code(), TKS_OK);
  }
}

/// OpenImageIO would stretch what does not fill its type.
TEST_F(HeightVoids, GreymapsAreReadExactlyOrRefused) {
  for (const unsigned white : {255U, 65535U, 200U, 1000U}) {
    std::string text = "P2\n# 9 9 9\n4 2 " + std::to_string(white) + "\n0 1 2 3 4 5 6 199\n";
    const auto heights = readHeights(save("a.pgm", std::vector(text.begin(), text.end())));
    const bool fits = white == 255 || white == 65535;
    EXPECT_EQ(heights.status().code(), fits ? TKS_OK : TKS_USAGE) << heights.status().message();
    if (!fits || !heights.ok()) continue;
    EXPECT_EQ(heights->data[white == 255 ? 7 : 14], std::byte{199});
    EXPECT_EQ(heights->data.size(), white == 255 ? 8U : 16U);
  }
}

/// OpenImageIO 2.4 takes one off those above 32768.
TEST_F(HeightVoids, GreymapsOf16BitsAreReadExactly) {
  const std::vector<uint16_t> expected{0, 255, 256, 32768, 32769, 65535};
  const std::string head = "\n# of a mountain\n3 2\n65535\n";
  std::string text = "P2" + head, binary = "P5" + head;
  for (const uint16_t sample : expected) {
    text += std::to_string(sample) + " # here\n";
    binary += {static_cast<char>(sample >> 8), static_cast<char>(sample)};
  }
  for (const std::string& file : {text, binary}) {
    const auto heights = readHeights(save("a.pgm", std::vector(file.begin(), file.end())));
    ASSERT_TRUE(heights.ok()) << heights.status().message();
    EXPECT_EQ(heights->width, 3U);
    EXPECT_EQ(heights->sample, TKS_U16);
    EXPECT_TRUE(test::sameBytes(heights->data, std::as_bytes(std::span(expected))));
    const std::vector<char> cut(file.begin(), file.end() - (file == text ? 13 : 1));
    EXPECT_EQ(readHeights(save("b.pgm", cut)).status().code(), TKS_IO);
  }
  const std::string above = "P2\n1 2\n65535\n7 65536\n";
  const auto damaged = readHeights(save("c.pgm", std::vector(above.begin(), above.end())));
  EXPECT_EQ(damaged.status().code(), TKS_IO);
}

TEST_F(HeightVoids, FitsIsRefused) {
  std::string fits;
  for (std::string card : {"SIMPLE  =                    T", "BITPIX  =                    8",
                           "NAXIS   =                    2", "NAXIS1  =                    3",
                           "NAXIS2  =                    2", "END"}) {
    card.resize(80, ' ');
    fits += card;
  }
  fits.resize(2880, ' ');
  fits.resize(2 * size_t{2880});
  const auto heights = readHeights(save("a.fits", std::vector(fits.begin(), fits.end())));
  EXPECT_EQ(heights.status().code(), TKS_IO);
  EXPECT_NE(heights.status().message().find("gdal_translate"), std::string::npos);
}

}  // namespace
}  // namespace tetrakis::tools
