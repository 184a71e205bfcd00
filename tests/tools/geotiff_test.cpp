// SPDX-License-Identifier: Apache-2.0
// TIFF files of other makers: GeoTIFF tags, right, odd and broken, and sample layouts to refuse.
#include <cmath>
#include <limits>

#include "apps/tools/files/files.hpp"
#include "apps/tools/files/pictures/tiff.hpp"
#include "tests/support/same_bytes.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/tiny_tiff.hpp"

namespace tetrakis::tools {
namespace {

using test::ScratchFolder;
using test::TinyTiff;

constexpr uint16_t kPixelScale = 33550, kTiepoint = 33922, kTransformation = 34264;
constexpr uint16_t kGeoKeys = 34735, kGeoDoubles = 34736, kGeoAscii = 34737;

class GeoTiff : public ScratchFolder {
 protected:
  TinyTiff tiff{4, 2, 1, 8, {1, 2, 3, 4, 5, 6, 7, 8}};

  Notes notes;

  HeightFile read() {
    notes.clear();
    const auto heights = readHeights(save("a.tif", tiff.bytes()), {}, &notes);
    EXPECT_TRUE(heights.ok()) << heights.status().message();
    return heights.ok() ? *heights : HeightFile{};
  }
  void degreesAt(double north) {
    tiff.doubles(kPixelScale, {0.01, 0.02, 0});
    tiff.doubles(kTiepoint, {0, 0, 0, 7, north, 0});
    tiff.shorts(kGeoKeys, {1, 1, 0, 2, 1024, 0, 1, 2, 2048, 0, 1, 4326});
  }
};

TEST_F(GeoTiff, DegreesBecomeMetresAtTheCentre) {
  degreesAt(60.02);  // rows of 0.02 degrees on both sides of 60 degrees
  const HeightFile heights = read();
  // By the usual series for WGS 84 (see files_test.cpp), at exactly 60 degrees.
  EXPECT_NEAR(heights.spacing_x, 0.01 * 55800.0, 0.01);
  EXPECT_NEAR(heights.spacing_y, 0.02 * 111412.2, 0.01);
  EXPECT_EQ(heights.crs, "EPSG:4326");
}

/// Web Mercator shows the ground at 60 degrees twice as large as it is.
TEST_F(GeoTiff, MapsAreMeasuredOnTheGround) {
  const auto project = [&](uint16_t crs, double east, double north) {
    tiff.doubles(kPixelScale, {20, 10, 0});
    tiff.doubles(kTiepoint, {0, 0, 0, east, north, 0});
    tiff.shorts(kGeoKeys, {1, 1, 0, 3, 1024, 0, 1, 1, 3072, 0, 1, crs, 3076, 0, 1, 9001});
    return read();
  };
  const HeightFile mercator = project(3857, 700000, 8399738);
  EXPECT_NEAR(mercator.spacing_x, 20 * 0.5 * 1.0025, 0.01);  // N(60 degrees) = 1.0025 a
  EXPECT_NEAR(mercator.spacing_y, 10 * 0.5 * 1.0008, 0.01);
  EXPECT_NEAR(project(32632, 500000, 6600000).spacing_x, 20, 1e-9);
  EXPECT_EQ(project(3857, 1e300, 0).spacing_x, 20);
}

/// On its own ellipsoid: a degree of the Moon has 30 km.
TEST_F(GeoTiff, DegreesOfOtherWorlds) {
  degreesAt(60.02);
  tiff.shorts(kGeoKeys, {1,    1,     0, 4, 1024, 0, 1, 2, 2048, 0, 1, 32767, 2057, 34736, 1, 0,  //
                         2058, 34736, 1, 1});
  tiff.doubles(kGeoDoubles, {1737400, 1737400});
  EXPECT_NEAR(read().spacing_y, 0.02 * 30323.35, 0.01);
  EXPECT_NEAR(read().spacing_x, 0.01 * 30323.35 / 2, 0.01);
}

TEST_F(GeoTiff, DegreesWithoutAPlaceStayUnknown) {
  degreesAt(0);
  tiff.remove(kTiepoint);
  EXPECT_EQ(read().spacing_x, 0);
  for (const double north : {90.02, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    degreesAt(north);
    EXPECT_EQ(read().spacing_x, 0) << north;
    EXPECT_EQ(read().spacing_y, 0) << north;
  }
}

TEST_F(GeoTiff, ProjectedUnitsBecomeMetres) {
  tiff.doubles(kPixelScale, {10, 20, 0});
  const std::pair<uint16_t, double> units[] = {
      {9001, 1}, {9002, 0.3048}, {9003, 1200.0 / 3937}, {9036, 1000}, {9999, 0}};
  for (const auto& [unit, metres] : units) {
    tiff.shorts(kGeoKeys, {1, 1, 0, 3, 1024, 0, 1, 1, 3072, 0, 1, 32645, 3076, 0, 1, unit});
    const HeightFile heights = read();
    EXPECT_DOUBLE_EQ(heights.spacing_x, 10 * metres);
    EXPECT_DOUBLE_EQ(heights.spacing_y, 20 * metres);
    EXPECT_EQ(heights.crs, "EPSG:32645");
  }
}

/// GDAL leaves the unit keys out of compound CRSs.
TEST_F(GeoTiff, UnitsOfCompoundSystemsAreLookedUp) {
  constexpr double kSurveyFoot = 1200.0 / 3937;
  struct Case {
    uint16_t horizontal, vertical;
    double metres;
    const char* unit;
  };
  const Case cases[] = {{2227, 6360, kSurveyFoot, "us-ft"}, {2227, 5703, kSurveyFoot, "m"},
                        {2222, 8228, 0.3048, "ft"},         {26910, 5703, 1, "m"},
                        {26910, 6360, 1, "us-ft"},          {2227, 0, kSurveyFoot, ""}};
  tiff.doubles(kPixelScale, {100, 50, 0});
  for (const auto& [horizontal, vertical, metres, unit] : cases) {
    tiff.shorts(kGeoKeys,
                {1, 1, 1, 3, 1024, 0, 1, 1, 3072, 0, 1, horizontal, 4096, 0, 1, vertical});
    const HeightFile heights = read();
    EXPECT_DOUBLE_EQ(heights.spacing_x, 100 * metres) << horizontal;
    EXPECT_DOUBLE_EQ(heights.spacing_y, 50 * metres) << horizontal;
    EXPECT_EQ(heights.unit, unit) << vertical;
    EXPECT_TRUE(notes.empty()) << horizontal;
  }
}

TEST_F(GeoTiff, OwnUnitsHaveASize) {
  tiff.doubles(kPixelScale, {10, 20, 0});
  tiff.doubles(kGeoDoubles, {7, 0.25});
  tiff.shorts(kGeoKeys, {1, 1,     0,    4, 1024, 0,     1,    1,           3072, 0,
                         1, 32767, 3076, 0, 1,    32767, 3077, kGeoDoubles, 1,    1});
  EXPECT_EQ(read().spacing_x, 2.5);
  EXPECT_EQ(read().spacing_y, 5);
}

TEST_F(GeoTiff, CitationsMayNameTheUnit) {
  const std::pair<const char*, double> citations[] = {
      {"NAD83 / California zone 3 (ftUS)", 1200.0 / 3937},
      {"NAD83 / UTM zone 10N + NAVD88 height (ftUS)", 1},
      {"our zone (ft)", 0.3048},
      {"our zone + our height (ftUS)", 0},
      {"PCS Name = ours\nLUnits = US_Survey_Feet\n", 1200.0 / 3937},
      {"ESRI PE String = PROJCS[\"ours\",GEOGCS[\"GCS\",DATUM[\"D\",SPHEROID[\"WGS_1984\","
       "6378137.0,298.257223563]],PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]],"
       "PROJECTION[\"Mercator\"],PARAMETER[\"Central_Meridian\",0.0],"
       "PARAMETER[\"Standard_Parallel_1\",0.0],UNIT[\"Foot\",0.3048]]",
       0.3048},
      {"California zone", 0}};
  tiff.doubles(kPixelScale, {10, 10, 0});
  for (const auto& [citation, metres] : citations) {
    const auto length = static_cast<uint16_t>(std::string(citation).size() + 1);
    tiff.ascii(kGeoAscii, std::string(citation) + "|");
    tiff.shorts(kGeoKeys,
                {1, 1, 1, 3, 1024, 0, 1, 1, 1026, kGeoAscii, length, 0, 3072, 0, 1, 32767});
    EXPECT_DOUBLE_EQ(read().spacing_x, 10 * metres) << citation;
    EXPECT_EQ(notes.size(), metres > 0 ? 0U : 1U) << citation;
  }
}

/// Nothing is guessed where a metre may be a foot.
TEST_F(GeoTiff, UnknownUnitsAreNoted) {
  tiff.doubles(kPixelScale, {10, 10, 0});
  tiff.shorts(kGeoKeys, {1, 1, 1, 3, 1024, 0, 1, 1, 3072, 0, 1, 9, 4096, 0, 1, 9});
  const HeightFile heights = read();
  EXPECT_EQ(heights.spacing_x, 0);
  EXPECT_EQ(heights.unit, "");
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_EQ(notes[0].option, "--spacing");
  EXPECT_EQ(notes[1].option, "--unit");
}

TEST_F(GeoTiff, RotatedGridsHaveASpacing) {
  tiff.doubles(kTransformation, {3, 8, 0, 500, 4, -6, 0, 900, 0, 0, 0, 0, 0, 0, 0, 1});
  tiff.shorts(kGeoKeys, {1, 1, 0, 2, 1024, 0, 1, 1, 3076, 0, 1, 9001});
  const HeightFile heights = read();
  EXPECT_DOUBLE_EQ(heights.spacing_x, 5);
  EXPECT_DOUBLE_EQ(heights.spacing_y, 10);
}

TEST_F(GeoTiff, CitationsAndVerticalKeys) {
  tiff.shorts(kGeoKeys, {1,    1,         0, 5, 1024, 0,         1, 1, 3072, 0, 1, 32767,
                         3073, kGeoAscii, 8, 0, 4097, kGeoAscii, 5, 8, 4099, 0, 1, 9002});
  tiff.ascii(kGeoAscii, "my grid|NAVD|");
  const HeightFile heights = read();
  EXPECT_EQ(heights.crs, "my grid");
  EXPECT_EQ(heights.vertical_datum, "NAVD");
  EXPECT_EQ(heights.unit, "ft");
}

TEST_F(GeoTiff, GdalMetadata) {
  tiff.ascii(TinyTiff::kGdalMetadata,
             "<GDALMetadata><Item name=\"STATISTICS_MEAN\" sample=\"0\">5</Item>"
             "<Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.25</Item>"
             "<Item name=\"SCALE\" sample=\"1\" role=\"scale\">7</Item>"
             "<Item name=\"OFFSET\" sample=\"0\" role=\"offset\">-12</Item>"
             "<Item name=\"UNITTYPE\" sample=\"0\" role=\"unittype\">metre</Item></GDALMetadata>");
  tiff.ascii(TinyTiff::kGdalNodata, " 8");
  const HeightFile heights = read();
  EXPECT_EQ(heights.scale, 0.25);
  EXPECT_EQ(heights.offset, -12);
  EXPECT_EQ(heights.unit, "m");
  EXPECT_EQ(heights.nodata, 8);
}

TEST_F(GeoTiff, PlacesAreThoseOfGdal) {
  tiff.shorts(kGeoKeys, {1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32645});
  tiff.doubles(kPixelScale, {10, 20, 0});
  tiff.doubles(kTiepoint, {1, 2, 0, 500, 900, 0});
  EXPECT_EQ(read().geotransform, (GeoTransform{490, 10, 0, 940, 0, -20}));
  EXPECT_EQ(read().registration, TKS_REGISTRATION_AREA);
  EXPECT_EQ(read().geo_keys, "");
  tiff.shorts(kGeoKeys, {1, 1, 0, 2, 1024, 0, 1, 1, 1025, 0, 1, 2});
  EXPECT_EQ(read().geotransform, (GeoTransform{485, 10, 0, 950, 0, -20}));
  EXPECT_EQ(read().registration, TKS_REGISTRATION_POINT);
  tiff.remove(kTiepoint);
  EXPECT_FALSE(read().geotransform);
  tiff.remove(kPixelScale);
  tiff.doubles(kTransformation, {3, 8, 0, 500, 4, -6, 0, 900, 0, 0, 0, 0, 0, 0, 0, 1});
  EXPECT_EQ(read().geotransform, (GeoTransform{494.5, 3, 8, 901, 4, -6}));
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300}) {
    tiff.doubles(kTransformation, {3, 8, 0, bad, 4, -6, 0, 900, 0, 0, 0, 0, 0, 0, 0, 1});
    EXPECT_FALSE(read().geotransform) << bad;
  }
}

/// To GDAL the heights of GeoTIFF 1.0 have no CRS: that of a vertical one comes back as 1.0.
TEST_F(GeoTiff, VerticalKeysKeepTheirRevision) {
  const auto revision = [this](uint16_t minor, uint16_t vertical) {
    tiff.shorts(kGeoKeys, {1, 1, minor, 3, 1024, 0, 1, 1, 3072, 0, 1, 32633, vertical, 0, 1,
                           uint16_t(vertical == 4096 ? 5773 : 9001)});
    const HeightFile heights = read();
    EXPECT_EQ(heights.unit, "m");
    EXPECT_EQ(heights.geo_keys.starts_with("1.0 1024=1 3072=32633 "), minor == 0);
    EXPECT_TRUE(writeHeights(path("b.tif"), heights).ok());
    const auto file = TiffFile::open(path("b.tif"), "r");
    EXPECT_TRUE(file.ok());
    const auto words = tagValues<uint16_t>(file->get(), kGeoKeys, TIFF_SHORT);
    EXPECT_EQ(std::vector(words.begin(), words.begin() + 3), (std::vector<uint16_t>{1, 1, minor}));
    EXPECT_EQ(readHeights(path("b.tif"))->geo_keys, heights.geo_keys);
  };
  for (const int vertical : {4096, 4099})
    for (const int minor : {0, 1})
      revision(static_cast<uint16_t>(minor), static_cast<uint16_t>(vertical));
  tiff.shorts(kGeoKeys, {1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32633});
  EXPECT_EQ(read().geo_keys, "") << "nothing depends on the revision";
}

/// Heights of three axes and grads have units that PROJ knows.
TEST_F(GeoTiff, SpatialSystemsAndGradsHaveUnits) {
  tiff.shorts(kGeoKeys, {1, 1, 1, 3, 1024, 0, 1, 2, 2048, 0, 1, 4326, 4096, 0, 1, 4979});
  EXPECT_EQ(read().crs, "EPSG:4979");
  EXPECT_EQ(read().unit, "m");
  EXPECT_EQ(read().geo_keys, "");
  tiff.doubles(kPixelScale, {0.001, 0.001, 0});
  tiff.doubles(kTiepoint, {0, 0, 0, 2, 50, 0});
  tiff.shorts(kGeoKeys, {1, 1, 1, 2, 1024, 0, 1, 2, 2048, 0, 1, 4807});
  const double north = read().spacing_y;
  EXPECT_NEAR(north, 100, 0.5) << "a ten-thousandth of a quarter of the meridian";
  for (const int unit : {9101, 9102, 9105}) {
    tiff.shorts(kGeoKeys, {1, 1, 1, 3, 1024, 0, 1, 2, 2048, 0, 1, 4807, 2054, 0, 1,
                           static_cast<uint16_t>(unit)});
    tiff.doubles(kTiepoint, {0, 0, 0, 0, 0.5, 0});
    const double degrees = unit == 9101 ? 57.29578 : unit == 9102 ? 1 : 0.9;
    EXPECT_NEAR(read().spacing_y / degrees, 110.6, 1.2) << unit;
  }
}

/// What crs and vertical_datum do not say is kept, and comes back from a file that is written.
TEST_F(GeoTiff, KeysOfOtherMakersComeBack) {
  tiff.shorts(kGeoKeys, {1,    1,           0,    6, 1024, 0,           1,    1,         1025, 0,
                         1,    1,           3072, 0, 1,    32767,       3073, kGeoAscii, 10,   0,
                         3077, kGeoDoubles, 1,    1, 5000, kGeoDoubles, 2,    0});
  tiff.ascii(kGeoAscii, "my \"grid\"|");
  tiff.doubles(kGeoDoubles, {7, 0.25});
  tiff.doubles(kPixelScale, {10, 20, 0});
  tiff.doubles(kTiepoint, {0, 0, 0, 500, 900, 0});
  const HeightFile heights = read();
  EXPECT_EQ(heights.crs, "my \"grid\"");
  EXPECT_EQ(heights.geo_keys, "1024=1 3072=32767 3073=\"my \"\"grid\"\"\" 3077=0.25 5000=7.0,0.25");
  ASSERT_TRUE(writeHeights(path("b.tif"), heights).ok());
  const auto again = readHeights(path("b.tif"));
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->geo_keys, heights.geo_keys);
  EXPECT_EQ(again->geotransform, heights.geotransform);
  // Streams hold any text: what are no keys is left out.
  for (const char* text : {"1024", "1024=", "1024=1 1024=2", "1024=1  3072=7", "1024=65536", "=1",
                           "1024=-1", "3073=\"open", "3077=1.0,", "3077=nan", "99999=1", "\n"}) {
    HeightFile hostile = heights;
    hostile.geo_keys = text;
    ASSERT_TRUE(writeHeights(path("b.tif"), hostile).ok()) << text;
    EXPECT_EQ(readHeights(path("b.tif"))->crs, heights.crs) << text;
  }
}

/// Older files have texts in ISO 8859-1; streams have UTF-8.
TEST_F(GeoTiff, TextsBecomeUtf8) {
  tiff.shorts(kGeoKeys, {1, 1, 0, 3, 1024, 0, 1, 1, 3072, 0, 1, 32767, 3073, kGeoAscii, 8, 0});
  tiff.ascii(kGeoAscii, "Z\xFCrich\xB2|");
  tiff.ascii(TinyTiff::kGdalMetadata,
             "<GDALMetadata><Item sample=\"0\" role=\"unittype\">m\xB2</Item>"
             "<Item sample=\"0\" role=\"description\">H\xC3\xB6hen</Item></GDALMetadata>");
  const HeightFile heights = read();
  EXPECT_EQ(heights.crs, "Z\xC3\xBCrich\xC2\xB2");
  EXPECT_EQ(heights.unit, "m\xC2\xB2");
  EXPECT_EQ(heights.description, "H\xC3\xB6hen");
}

/// Tags that make no sense cost the information, not the heights.
/// What is not used is not left out silently: of heights, nor of a texture.
TEST_F(GeoTiff, TransformsOfNoUseAreNoted) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto expectNotes = [this](bool noted) {
    const std::string text =
        noted ? "its geotransform is not used: a scale is 0, or a number is NaN or too large" : "";
    const HeightFile heights = read();
    EXPECT_EQ(heights.geotransform.has_value(), !noted);
    ASSERT_EQ(notes.size(), noted ? 1U : 0U);
    if (noted) {
      EXPECT_EQ(notes[0].text, text);
    }
    std::string remark;
    const auto image = readImage(path("a.tif"), &remark);
    ASSERT_TRUE(image.ok());
    EXPECT_EQ(remark, text);
  };
  tiff.doubles(kTiepoint, {0, 0, 0, 7, 60, 0});
  for (const double scale : {0.0, kNone, 1e300, 2.0}) {
    tiff.doubles(kPixelScale, {2, scale, 0});
    expectNotes(scale != 2.0);
  }
  tiff.doubles(kTiepoint, {0, 0, 0, kNone, 60, 0});
  expectNotes(true);
  tiff.remove(kPixelScale);
  tiff.remove(kTiepoint);
  std::vector<double> matrix = {1, 0, 0, 7, 0, -1, 0, 60, 0, 0, 0, 0, 0, 0, 0, 1};
  tiff.doubles(kTransformation, matrix);
  expectNotes(false);
  matrix[1] = kNone;
  tiff.doubles(kTransformation, matrix);
  expectNotes(true);
}

TEST_F(GeoTiff, BrokenTagsCountAsMissing) {
  const TinyTiff plain = tiff;
  const auto expectPlain = [this, &plain](const char* what) {
    SCOPED_TRACE(what);
    const HeightFile heights = read();
    EXPECT_EQ(heights.data.size(), 8U);
    EXPECT_EQ(heights.spacing_x, 0);
    EXPECT_EQ(heights.scale, 1);
    EXPECT_EQ(heights.offset, 0);
    EXPECT_FALSE(heights.nodata);
    EXPECT_EQ(heights.crs + heights.unit + heights.vertical_datum, "");
    tiff = plain;
  };
  tiff.shorts(kPixelScale, {1, 1, 0});
  tiff.shorts(kGeoKeys, {1, 1, 0, 2, 1024, 0, 1, 1, 3076, 0, 1, 9001});
  expectPlain("pixel scale of another type");
  tiff.doubles(kPixelScale, {1});
  tiff.shorts(kGeoKeys, {1, 1, 0, 2, 1024, 0, 1, 1, 3076, 0, 1, 9001});
  expectPlain("pixel scale too short");
  for (const double bad : {0.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    tiff.doubles(kPixelScale, {bad, 1, 0});
    tiff.shorts(kGeoKeys, {1, 1, 0, 2, 1024, 0, 1, 1, 3076, 0, 1, 9001});
    expectPlain("pixel scale that is no length");
  }
  tiff.shorts(kGeoKeys, {1, 1, 0});
  expectPlain("key directory without a header");
  tiff.shorts(kGeoKeys, {1, 1, 0, 65535, 1024, 0, 1});
  expectPlain("key directory that promises too much");
  tiff.shorts(kGeoKeys, {1, 1, 0, 1, 4097, kGeoAscii, 65535, 65535});
  tiff.ascii(kGeoAscii, "x");
  expectPlain("text outside the text tag");
  tiff.ascii(TinyTiff::kGdalMetadata,
             "<GDALMetadata><Item sample=\"0\" role=\"scale\">0</Item><Item");
  tiff.ascii(TinyTiff::kGdalNodata, "none");
  expectPlain("metadata that does not parse");
  tiff.ascii(TinyTiff::kGdalMetadata,
             "<GDALMetadata><Item sample=\"0\" role=\"scale\">0</Item></GDALMetadata>");
  Notes told;
  EXPECT_EQ(readHeights(save("a.tif", tiff.bytes()), {}, &told)->scale, 1);
  ASSERT_FALSE(told.empty());
  EXPECT_NE(told[0].text.find("scale '0' is none"), std::string::npos) << told[0].text;
  EXPECT_EQ(told[0].option, "--scale");
  tiff.ascii(TinyTiff::kGdalMetadata,
             "<GDALMetadata><Item role=\"offset\">inf</Item></GDALMetadata>");
  tiff.ascii(TinyTiff::kGdalNodata, "");
  expectPlain("metadata that is no number");
}

TEST_F(GeoTiff, LayoutsThatAreNotReadExactlyAreRefused) {
  const TinyTiff plain = tiff;
  const auto expectRefused = [this, &plain](const char* what) {
    const auto read = readHeights(save("a.tif", tiff.bytes()));
    EXPECT_EQ(read.status().code(), TKS_USAGE) << what << ": " << read.status().message();
    tiff = plain;
  };
  tiff.shorts(TinyTiff::kPhotometric, {3});
  tiff.shorts(TinyTiff::kColorMap, std::vector<uint16_t>(3 * 256));
  expectRefused("palette");
}

/// Where nothing is stated, a sample has one bit (TIFF 6.0, BitsPerSample).
TEST_F(GeoTiff, FewBitsAreReadAsTheyAre) {
  for (const uint16_t bits : {uint16_t{1}, uint16_t{4}}) {
    TinyTiff few(
        5, 1, 1, bits,
        bits == 1 ? std::vector<uint8_t>{0b10110000} : std::vector<uint8_t>{0x1F, 0x02, 0x30});
    if (bits == 1) few.remove(TinyTiff::kBitsPerSample);
    const auto read = readHeights(save("a.tif", few.bytes()));
    ASSERT_TRUE(read.ok()) << read.status().message();
    EXPECT_EQ(read->sample, TKS_U8);
    const std::vector<int> wanted =
        bits == 1 ? std::vector{1, 0, 1, 1, 0} : std::vector{1, 15, 0, 2, 3};
    for (size_t i = 0; i < wanted.size(); ++i) EXPECT_EQ(int(read->data[i]), wanted[i]) << i;
  }
}

/// Heights are no shades.
TEST_F(GeoTiff, WhiteStoredAsZeroChangesNoHeight) {
  const auto heights = readHeights(save("a.tif", tiff.bytes()));
  tiff.shorts(TinyTiff::kPhotometric, {0});
  const auto white = readHeights(save("b.tif", tiff.bytes()));
  ASSERT_TRUE(heights.ok() && white.ok()) << white.status().message();
  EXPECT_TRUE(test::sameBytes(white->data, heights->data));
}

/// A few bytes may declare any size.
TEST_F(GeoTiff, DeclaredSizesAreChecked) {
  tiff.longs(TinyTiff::kWidth, {1U << 30});
  tiff.longs(TinyTiff::kHeight, {1U << 30});
  EXPECT_NE(readHeights(save("a.tif", tiff.bytes())).status().code(), TKS_OK);
  tiff.longs(TinyTiff::kWidth, {1U << 16});
  tiff.longs(TinyTiff::kHeight, {1U << 16});
  EXPECT_NE(readHeights(save("a.tif", tiff.bytes())).status().code(), TKS_OK);
}

}  // namespace
}  // namespace tetrakis::tools
