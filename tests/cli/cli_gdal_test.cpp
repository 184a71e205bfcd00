// SPDX-License-Identifier: Apache-2.0
// GDAL as the judge: of a GeoTIFF that went through a stream gdalinfo says what it says of the
// source. The sources are made by gdal_translate and gdalwarp.
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

using Json = nlohmann::json;

class CliGdal : public CliTest {
 protected:
  void SetUp() override {
    CliTest::SetUp();
    tools::HeightFile plain;
    plain.width = 30;
    plain.height = 20;
    plain.sample = TKS_I16;
    for (uint32_t i = 0; i < plain.width * plain.height; ++i)
      appendSample(plain, static_cast<uint16_t>((3 * (i / 30) + 2 * (i % 30)) % 97 + 1));
    ASSERT_TRUE(tools::writeHeights(path("base.tif"), plain).ok());
  }

  void run(const std::string& command) {
    const Outcome outcome = shell(command);
    ASSERT_EQ(outcome.code, 0) << command << "\n" << outcome.err;
  }

  Json gdalinfo(const std::string& name) {
    const Outcome outcome = shell("gdalinfo -json " + name);
    const Json json = Json::parse(outcome.out, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << name << ": " << outcome.err;
    return json;
  }

  /// What has to be kept, of what gdalinfo says.
  Json kept(const std::string& name) {
    const Json json = gdalinfo(name);
    Json out{{"size", json.value("size", Json())},
             {"geotransform", json.value("geoTransform", Json())},
             {"crs", json.value("coordinateSystem", Json())},
             {"area or point", json.value("metadata", Json::object())
                                   .value("", Json::object())
                                   .value("AREA_OR_POINT", Json())},
             {"bands", Json::array()}};
    for (const Json& band : json.value("bands", Json::array())) {
      Json& kept = out["bands"].emplace_back();
      for (const char* key : {"type", "noDataValue", "unit", "scale", "offset", "description"})
        kept[key] = band.value(key, Json());
    }
    return out;
  }

  /// Through a lossless stream and a prefix of it.
  void expectKept(const std::string& name) {
    SCOPED_TRACE(name);
    const std::string in = name + ".tif";
    Json wanted = kept(in);
    if (name == "geographic_3d") wanted["bands"][0]["unit"] = "m";  // that of its third axis
    ASSERT_EQ(cli("-q encode " + in + " --lossless -f -o s.tks").code, 0);
    ASSERT_EQ(cli("decode s.tks -f --height out.tif").code, 0);
    EXPECT_EQ(kept("out.tif"), wanted);
    const auto header = Json::parse(cli("info s.tks --json").out)["header_bytes"].get<int>();
    ASSERT_EQ(cli("decode s.tks -f --bytes " + std::to_string(header) + " --height cut.tif").code,
              0);
    EXPECT_EQ(kept("cut.tif"), wanted);
  }
};

/// What gdal_translate or gdalwarp makes of base.tif.
struct Kind {
  const char* name;
  const char* command;
};

/// Writes a VRT of base.tif with a part of it replaced by sed.
#define TETRAKIS_VRT(edit)                                    \
  "gdal_translate -q -of VRT base.tif v.vrt && sed -i '" edit \
  "' v.vrt && gdal_translate -q "                             \
  "v.vrt "

constexpr Kind kKinds[] = {
    {"utm_int16",
     "gdal_translate -q -a_srs EPSG:32632 -a_ullr 399960 5300040 400260 5299840 "
     "base.tif "},
    {"geographic_float32_nodata",
     "gdal_translate -q -ot Float32 -a_srs EPSG:4326 -a_ullr 9.9998611111111 47.0001388889 "
     "10.0081944444 46.9945833333 -a_nodata -3.4028234663852886e+38 base.tif "},
    {"compound_navd88",
     "gdal_translate -q -a_srs EPSG:26910+5703 -a_ullr 5e5 4500200 500300 4500000 base.tif "},
    {"compound_geographic",
     "gdal_translate -q -a_srs EPSG:5498 -a_ullr -120 40.2 -119.7 40 base.tif "},
    {"state_plane_us_feet",
     "gdal_translate -q -a_srs EPSG:2227+6360 -a_ullr 6e6 2100200 6000300 2100000 base.tif "},
    {"rotated", TETRAKIS_VRT("s|<VRTRasterBand|<GeoTransform>500000,3,8,4000000,4,-6"
                             "</GeoTransform><SRS>EPSG:32633</SRS><VRTRasterBand|")},
    {"pixel_is_point",
     "gdal_translate -q -mo AREA_OR_POINT=Point -a_srs EPSG:25832 -a_ullr "
     "399955.1 5300045.7 400255.2 5299845.3 base.tif "},
    {"scaled_int16",
     "gdal_translate -q -a_scale 0.1 -a_offset -100 -a_nodata -9999 -a_srs "
     "EPSG:32632 -a_ullr 399960 5300040 400260 5299840 base.tif "},
    {"float32_nan",
     "gdal_translate -q -ot Float32 -a_nodata nan -a_srs EPSG:3035 -a_ullr 4321000 "
     "3210500 4321300 3210300 base.tif "},
    {"web_mercator_uint8",
     "gdal_translate -q -ot Byte -a_nodata 0 -a_srs EPSG:3857 -a_ullr 7e5 6600200 700300 6600000 "
     "base.tif "},
    {"albers_feet_uint16",
     "gdal_translate -q -ot UInt16 -a_srs '+proj=aea +lat_1=29.5 +lat_2=45.5 +lat_0=23 +lon_0=-96 "
     "+datum=NAD83 +units=us-ft' -a_ullr 7e5 6600200 700300 6600000 base.tif "},
    {"warped_lambert",
     "gdal_translate -q -a_srs EPSG:32632 -a_ullr 399960 5300040 400260 5299840 base.tif u.tif && "
     "gdalwarp -q -dstnodata -32768 -t_srs '+proj=lcc +lat_1=44 +lat_2=49 +lat_0=46.5 +lon_0=3 "
     "+x_0=700000 +y_0=6600000 +ellps=GRS80 +units=m' u.tif "},
    {"mercator_with_shift_uint32",
     "gdal_translate -q -ot UInt32 -a_srs '+proj=tmerc +lat_0=0 +lon_0=9 +k=0.9996 +x_0=500000 "
     "+ellps=bessel +towgs84=598.1,73.7,418.2,0.202,0.045,-2.455,6.7' -a_ullr 399960 5300040 "
     "400260 5299840 base.tif "},
    {"south_up_oblong",
     "gdal_translate -q -a_srs EPSG:32632 -a_ullr 399960.5 5299840.25 400271 5300047 base.tif "},
    {"described_feet", TETRAKIS_VRT("s|<ColorInterp>|<Description>bare earth</Description>"
                                    "<UnitType>ft</UnitType><ColorInterp>|")},
    {"no_crs_int32", "gdal_translate -q -ot Int32 -a_ullr 7 45 37.3 25 base.tif "},
    {"geographic_3d", "gdal_translate -q -a_srs EPSG:4979 -a_ullr 7 46.02 7.03 46 base.tif "},
    {"grads_from_paris", "gdal_translate -q -a_srs EPSG:4807 -a_ullr 2 54.02 2.03 54 base.tif "},
    {"local_grid",
     "gdal_translate -q -a_srs 'LOCAL_CS[\"site 7\",UNIT[\"metre\",1]]' -a_ullr 0 20 "
     "30 0 base.tif "},
    {"nothing", "gdal_translate -q base.tif "},
};

TEST_F(CliGdal, AFileThatWasDecodedSaysWhatItsSourceSays) {
  static_assert(std::size(kKinds) >= 12);
  for (const Kind& kind : kKinds) {
    run(kind.command + std::string(kind.name) + ".tif");
    if (HasFatalFailure()) return;
    expectKept(kind.name);
  }
}

/// The same place as in the whole, told by coordinates.
TEST_F(CliGdal, WindowsAndLevelsLieWhereTheyLay) {
  for (const size_t kind : {0, 5, 6, 13}) {
    SCOPED_TRACE(kKinds[kind].name);
    run(kKinds[kind].command + std::string("a.tif"));
    ASSERT_EQ(cli("-q encode a.tif --lossless -f -o s.tks").code, 0);
    ASSERT_EQ(cli("decode s.tks -f --window 5,3,12,10 --height w.tif").code, 0);
    run("gdal_translate -q -srcwin 5 3 12 10 a.tif g.tif");
    const Json window = kept("w.tif");
    Json wanted = kept("g.tif");
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(window["geotransform"][i], wanted["geotransform"][i].get<double>(), 1e-7) << i;
    wanted["geotransform"] = window["geotransform"];
    EXPECT_EQ(window, wanted);
    ASSERT_EQ(cli("decode s.tks -f --level 2 --height l.tif").code, 0);
    const Json whole = kept("a.tif")["geotransform"], level = kept("l.tif")["geotransform"];
    const auto middle = [](const Json& t, int axis, double column, double row) {
      return t[3 * axis].get<double>() + (column + 0.5) * t[3 * axis + 1].get<double>() +
             (row + 0.5) * t[3 * axis + 2].get<double>();
    };
    for (const int axis : {0, 1})
      for (const auto& [column, row] : {std::pair(0, 0), {1, 0}, {0, 1}, {7, 4}})
        EXPECT_NEAR(middle(level, axis, column, row), middle(whole, axis, 4 * column, 4 * row),
                    1e-7);
  }
}

TEST_F(CliGdal, CoordinatesOfAWindowMeetTheSamplesOfTheSource) {
  run(kKinds[0].command + std::string("a.tif"));
  ASSERT_EQ(cli("-q encode a.tif --lossless -o s.tks").code, 0);
  ASSERT_EQ(cli("decode s.tks --window 20,11,10,9 --height w.tif").code, 0);
  for (const char* place : {"400165 5299925", "400255 5299845", "400201.5 5299888"}) {
    const std::string at = std::string("gdallocationinfo -valonly -geoloc ");
    const std::string sample = shell(at + "w.tif " + place).out;
    EXPECT_EQ(sample, shell(at + "a.tif " + place).out) << place;
    EXPECT_GE(std::stoi("0" + sample), 1) << place;
  }
}

TEST_F(CliGdal, TexturesKeepAPlaceOfTheirOwn) {
  const char* const kPlaces[] = {
      "-a_srs EPSG:32632 -a_ullr 399960 5300040 400260 5299840",     // the ground of the heights
      "-a_srs EPSG:3857 -a_ullr 853000 6076000 853450.3 6075700.1",  // another system
      "-a_ullr 7 45 37 25",                                          // none
      "-mo AREA_OR_POINT=Point -a_srs EPSG:32632 -a_ullr 399960 5300040 400160 5299940"};
  run(kKinds[0].command + std::string("h.tif"));
  for (const std::string place : kPlaces) {
    SCOPED_TRACE(place);
    run("gdal_translate -q -ot Byte -b 1 -b 1 -b 1 -outsize 64 48 -r bilinear " + place +
        " base.tif t.tif");
    ASSERT_EQ(cli("-q encode h.tif --texture t.tif --lossless -f -o s.tks").code, 0);
    ASSERT_EQ(cli("decode s.tks -f --texture o.tif").code, 0);
    Json source = kept("t.tif");
    // A texture without a system lies in that of the heights.
    if (source["crs"].is_null()) source["crs"] = kept("h.tif")["crs"];
    if (source["area or point"].is_null()) source["area or point"] = kept("o.tif")["area or point"];
    EXPECT_EQ(kept("o.tif"), source);
    ASSERT_EQ(cli("-q encode --texture t.tif --bytes 2k -f -o s.tks").code, 0);
    ASSERT_EQ(cli("decode s.tks -f --window 10,20,30,8 --texture w.tif").code, 0);
    run("gdal_translate -q -srcwin 10 20 30 8 t.tif g.tif");
    const Json window = kept("w.tif"), wanted = kept("g.tif");
    EXPECT_EQ(window["crs"], wanted["crs"]);
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(window["geotransform"][i], wanted["geotransform"][i].get<double>(), 1e-7) << i;
  }
}

/// What is given of the heights leaves the rest of a CRS without a code alone.
TEST_F(CliGdal, AVerticalDatumThatIsGivenJoinsTheSystemOfTheFile) {
  run(kKinds[10].command + std::string("a.tif"));
  ASSERT_EQ(cli("-q encode a.tif --vertical-datum EPSG:5703 --lossless -o s.tks").code, 0);
  ASSERT_EQ(cli("decode s.tks --height o.tif").code, 0);
  const std::string wkt = kept("o.tif")["crs"]["wkt"];
  EXPECT_TRUE(wkt.starts_with("COMPOUNDCRS")) << wkt;
  EXPECT_NE(wkt.find("Albers Equal Area"), std::string::npos) << wkt;
  EXPECT_NE(wkt.find("NAVD88 height"), std::string::npos) << wkt;
}

/// --crs replaces what a file says; text is written where GDAL finds it.
TEST_F(CliGdal, SystemsThatAreGivenReachTheFile) {
  const auto nameOf = [this](const std::string& crs) {
    EXPECT_EQ(
        shell("\"$TETRAKIS\" -q encode base.tif --crs '" + crs + "' --lossless -f -o s.tks").code,
        0);
    EXPECT_EQ(cli("decode s.tks -f --height o.tif").code, 0);
    const Json crs_json = kept("o.tif")["crs"];
    return crs_json.is_null() ? "" : crs_json.value("wkt", "");
  };
  run("gdal_translate -q -a_srs EPSG:25832 -a_ullr 399960 5300040 400260 5299840 base.tif h.tif && "
      "mv h.tif base.tif");
  EXPECT_TRUE(nameOf("EPSG:2056").starts_with("PROJCRS[\"CH1903+ / LV95\""));
  EXPECT_TRUE(nameOf("EPSG:2056+5728").starts_with("COMPOUNDCRS[\"CH1903+ / LV95 + LN02 height\""));
  EXPECT_TRUE(nameOf("EPSG:4326").starts_with("GEOGCRS[\"WGS 84\""));
  const std::string wkt = shell(
                              "gdalsrsinfo -o wkt2 --single-line '+proj=laea +lat_0=50 +lon_0=7 "
                              "+ellps=GRS80'")
                              .out;
  const std::string written = nameOf(wkt.substr(wkt.find("PROJCRS")));
  EXPECT_NE(written.find("Lambert Azimuthal Equal Area"), std::string::npos) << written;
  EXPECT_NE(written.find("\"Latitude of natural origin\",50"), std::string::npos) << written;
}

TEST_F(CliGdal, WhatIsNotKeptIsTold) {
  run("gdal_translate -q -gcp 0 0 5 50 -gcp 30 0 6 50 -gcp 0 20 5 49 base.tif points.tif");
  run("gdal_translate -q -a_offset inf base.tif infinite.tif");
  const std::pair<const char*, const char*> files[] = {{"points.tif", "gdalwarp"},
                                                       {"infinite.tif", "--offset"}};
  for (const auto& [file, word] : files) {
    const Outcome told = cli(std::string("encode ") + file + " --lossless -f -o s.tks");
    EXPECT_EQ(told.code, 0) << told.err;
    EXPECT_NE(told.err.find(word), std::string::npos) << told.err;
  }
  EXPECT_EQ(cli("encode infinite.tif --offset 3 --lossless -f -o s.tks").err.find("note"),
            std::string::npos);
}

}  // namespace
}  // namespace tetrakis::test
