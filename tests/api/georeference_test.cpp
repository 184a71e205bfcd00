// SPDX-License-Identifier: Apache-2.0
// Where heights and texture lie: what the caller says comes back, from every prefix and at every
// level, in few bytes; and costs none where nothing is said.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "conformance/samples/header_parts.hpp"
#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

using Transform = std::array<double, 6>;

class GeoreferenceTest : public testing::Test {
 protected:
  GeoreferenceTest() {
    for (size_t i = 0; i < samples_.size(); ++i) samples_[i] = static_cast<uint8_t>(i * i / 7);
    heights_ = {};
    heights_.size = sizeof heights_;
    heights_.width = 24;
    heights_.height = 20;
    heights_.data = samples_.data();
    heights_.scale = 1;
    image_ = {};
    image_.size = sizeof image_;
    image_.width = 12;
    image_.height = 40;
    image_.channels = 1;
    image_.data = samples_.data();
    options_.size = sizeof options_;
    options_.lossless = 1;
  }

  template <class T>
  static void place(T& raster, const Transform& transform) {
    std::copy(transform.begin(), transform.end(), raster.geotransform);
    raster.has_geotransform = 1;
  }
  static Transform at(const double* given) {
    Transform transform;
    std::copy_n(given, transform.size(), transform.begin());
    return transform;
  }
  tks_status encode(bool textured) {
    tks_buffer buffer = {};
    char message[200] = "";
    const tks_status status = tks_encode(&heights_, textured ? &image_ : nullptr, &options_,
                                         &buffer, message, sizeof message);
    stream_.assign(buffer.data, buffer.data + buffer.size);
    message_ = message;
    tks_free_buffer(&buffer);
    return status;
  }
  size_t headerBytes(bool textured) {
    EXPECT_EQ(encode(textured), TKS_OK) << message_;
    return static_cast<size_t>(Stream(stream_).info().header_bytes);
  }

  std::vector<uint8_t> samples_ = std::vector<uint8_t>(24 * 20);
  tks_heights heights_;
  tks_image image_;
  tks_encode_options options_ = {};
  Bytes stream_;
  std::string message_;
};

/// Every form in which a header writes a geotransform, and numbers that are hard to write.
const std::vector<Transform> kTransforms = {
    {399960, 10, 0, 5300040, 0, -10},         // as large as the spacing
    {-180.125, 1.0 / 3, 0, 90, 0, -1.0 / 3},  // square
    {1e-300, 5, 0, -0.0, 0, 7},               // south-up
    {500000, 3, 8, 4e6, 4, -6},               // rotated
    {0, 10, -0.0, 0, 0, -10},
    {0x1.fffffffffffffp511, -0x1.fffffffffffffp511, 0, 0, 0, 5e-324},
    {}};

TEST_F(GeoreferenceTest, ComesBackBitForBitFromEveryPrefix) {
  heights_.spacing_x = heights_.spacing_y = 10;
  heights_.crs = "EPSG:32632";
  heights_.registration = TKS_REGISTRATION_POINT;
  heights_.description = "bare earth";
  heights_.geo_keys = "1024=1 1026=\"a\"";
  image_.registration = TKS_REGISTRATION_AREA;
  image_.crs = "EPSG:4326";
  for (size_t i = 0; i < kTransforms.size(); ++i) {
    const Transform other = kTransforms[(i + 1) % kTransforms.size()];
    place(heights_, kTransforms[i]);
    place(image_, other);
    for (size_t bytes = headerBytes(true); bytes <= stream_.size(); bytes += 97) {
      const Stream stream(Prefix(stream_).first(bytes));
      const tks_info& info = stream.info();
      ASSERT_EQ(stream.status(), TKS_OK) << stream.message();
      EXPECT_TRUE(info.has_geotransform && info.texture_has_geotransform);
      EXPECT_EQ(std::memcmp(info.geotransform, kTransforms[i].data(), sizeof(Transform)), 0) << i;
      EXPECT_EQ(std::memcmp(info.texture_geotransform, other.data(), sizeof(Transform)), 0) << i;
      EXPECT_EQ(info.registration, TKS_REGISTRATION_POINT);
      EXPECT_EQ(info.texture_registration, TKS_REGISTRATION_AREA);
      EXPECT_STREQ(info.description, "bare earth");
      EXPECT_STREQ(info.geo_keys, "1024=1 1026=\"a\"");
      EXPECT_STREQ(info.texture_crs, "EPSG:4326");
      EXPECT_STREQ(info.texture_geo_keys, "");
    }
  }
}

TEST_F(GeoreferenceTest, WhatIsUnknownStaysUnknownAndCostsNothing) {
  heights_.crs = "EPSG:32632";
  ASSERT_EQ(encode(true), TKS_OK);
  HeaderParts body = bodyOf(stream_);
  for (const uint64_t place : {uint64_t{68}, uint64_t{69}}) EXPECT_EQ(body.find(place), nullptr);
  const Stream stream(stream_);
  const tks_info& info = stream.info();
  EXPECT_FALSE(info.has_geotransform || info.texture_has_geotransform);
  EXPECT_EQ(at(info.geotransform), Transform{});
  EXPECT_EQ(info.registration, TKS_REGISTRATION_UNKNOWN);
  EXPECT_STREQ(info.description, "");
  EXPECT_STREQ(info.geo_keys, "");
  EXPECT_STREQ(info.texture_crs, "");
}

/// What a GIS user's common files take of a budget.
TEST_F(GeoreferenceTest, TakesFewBytes) {
  const size_t plain = headerBytes(false), textured = headerBytes(true);
  heights_.crs = "EPSG:32632";
  heights_.vertical_datum = "EPSG:5703";
  heights_.registration = TKS_REGISTRATION_AREA;
  place(heights_, {9.000138888888889, 1.0 / 3600, 0, 47.00013888888889, 0, -1.0 / 3600});
  EXPECT_LE(headerBytes(false), plain + 64);  // and the metadata that plain heights do not have
  heights_.spacing_x = heights_.spacing_y = 30;
  const size_t unplaced = headerBytes(true);
  place(heights_, {399960, 30, 0, 5300040, 0, -30});
  // Over the same ground, from corner to corner, in the same CRS.
  place(image_, {399960, 60, 0, 5300040, 0, -15});
  image_.crs = heights_.crs;
  image_.registration = TKS_REGISTRATION_AREA;
  EXPECT_LE(headerBytes(true), textured + 60);
  EXPECT_LE(headerBytes(true), unplaced + 20);
  const Stream stream(stream_);
  EXPECT_EQ(at(stream.info().texture_geotransform), at(image_.geotransform));
  EXPECT_STREQ(stream.info().texture_crs, "EPSG:32632");
}

/// Samples of a level lie on samples of the whole, whatever the registration.
TEST_F(GeoreferenceTest, LevelsKeepTheMiddlesOfTheirSamples) {
  place(heights_, {500000, 3, 8, 4e6, 4, -6});
  place(image_, {7, 0.25, 0, 46, 0, -0.5});
  ASSERT_EQ(encode(true), TKS_OK);
  Stream stream(stream_);
  const tks_info whole = stream.info();
  const auto middle = [](const double* t, double column, double row) {
    const double c = column + 0.5, r = row + 0.5;
    return std::pair(t[0] + c * t[1] + r * t[2], t[3] + c * t[4] + r * t[5]);
  };
  for (uint32_t level = 1; level <= whole.coarsest_level; ++level) {
    ASSERT_EQ(tks_set_levels(stream.get(), level, std::min(level, whole.texture_coarsest_level)),
              TKS_OK);
    tks_info info = {};
    info.size = sizeof info;
    ASSERT_EQ(tks_get_info(stream.get(), &info), TKS_OK);
    const double size = std::ldexp(1, static_cast<int>(level));
    EXPECT_EQ(middle(info.geotransform, 2, 3), middle(whole.geotransform, 2 * size, 3 * size));
    if (level > whole.texture_coarsest_level) continue;
    EXPECT_EQ(middle(info.texture_geotransform, 1, 2),
              middle(whole.texture_geotransform, size, 2 * size));
  }
}

/// Even where nothing is void.
TEST_F(GeoreferenceTest, NaNStaysDeclared) {
  heights_.has_nodata = 1;
  heights_.nodata = std::nan("");
  ASSERT_EQ(encode(false), TKS_OK);
  EXPECT_TRUE(Stream(stream_).info().has_nodata);
  EXPECT_TRUE(std::isnan(Stream(stream_).info().nodata));
}

TEST_F(GeoreferenceTest, WhatMakesNoSenseIsRefusedWithOneSentence) {
  const auto expectRefused = [this](const char* what) {
    EXPECT_EQ(encode(true), TKS_USAGE) << what;
    EXPECT_TRUE(message_.ends_with('.')) << what;
    EXPECT_EQ(std::count(message_.begin(), message_.end(), '\n'), 0);
  };
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 0x1p512}) {
    place(heights_, {0, 1, 0, 0, bad, -1});
    expectRefused("heights");
    heights_.has_geotransform = 0;
    EXPECT_EQ(encode(true), TKS_OK) << "nobody looks at it";
    place(image_, {bad, 1, 0, 0, 0, -1});
    expectRefused("texture");
    image_.has_geotransform = 0;
  }
  heights_.registration = static_cast<tks_registration>(3);
  expectRefused("registration");
  heights_.registration = TKS_REGISTRATION_UNKNOWN;
  const std::string longest(65535, 'x'), longer = longest + 'x';
  heights_.unit = heights_.crs = heights_.vertical_datum = longest.c_str();
  heights_.description = heights_.geo_keys = image_.crs = image_.geo_keys = longest.c_str();
  EXPECT_EQ(encode(true), TKS_OK) << message_;
  image_.geo_keys = longer.c_str();
  expectRefused("a text that is too long");
}

TEST_F(GeoreferenceTest, TextsAreUtf8) {
  for (const char* text : {"m\xC2\xB2", "\xE2\x82\xAC", "\xF0\x9F\x8F\x94",
                           "\xED\x9F\xBF\xEE\x80\x80", "\xF4\x8F\xBF\xBF", "\x7F"}) {
    heights_.unit = heights_.crs = heights_.description = image_.crs = text;
    EXPECT_EQ(encode(true), TKS_OK) << message_;
  }
  const char* const broken[] = {"m\xB2",
                                "\xC2",
                                "\xC0\x80",
                                "\xE2\x82",
                                "\xE0\x9F\xBF",
                                "\xED\xA0\x80",
                                "\xF4\x90\x80\x80",
                                "\xF0\x8F\xBF\xBF",
                                "\xE2\x82\xC2\xB2",
                                "\xFF",
                                "\x80"};
  for (const char* text : broken) {
    for (const char** field :
         {&heights_.unit, &heights_.vertical_datum, &heights_.crs, &heights_.description,
          &heights_.geo_keys, &image_.crs, &image_.geo_keys}) {
      const char* const before = std::exchange(*field, text);
      EXPECT_EQ(encode(true), TKS_USAGE);
      EXPECT_NE(message_.find("is not UTF-8."), std::string::npos) << message_;
      *field = before;
    }
  }
}

}  // namespace
}  // namespace tetrakis::test
