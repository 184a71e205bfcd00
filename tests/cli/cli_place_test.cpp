// SPDX-License-Identifier: Apache-2.0
// Where rasters lie, without tags: .hgt tiles by their names, world files beside pictures.
#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/cli_fixture.hpp"

#include "tetrakis/tetrakis.hpp"

namespace tetrakis::test {
namespace {

using Json = nlohmann::json;

class CliPlace : public CliTest {
 protected:
  std::optional<tools::GeoTransform> placeOf(const std::string& stream, const char* part) {
    const Json json = Json::parse(cli("info --json " + stream).out)[part]["geotransform"];
    if (json.is_null()) return std::nullopt;
    return json.get<tools::GeoTransform>();
  }
  Json gdalinfo(const std::string& name) {
    return Json::parse(shell("gdalinfo -json " + name).out, nullptr, false);
  }
  /// A square of 16-bit samples.
  void writeTile(const std::string& name, uint32_t side) {
    tools::HeightFile file;
    file.width = file.height = side;
    file.sample = TKS_I16;
    for (uint32_t i = 0; i < side * side; ++i) appendSample(file, static_cast<uint16_t>(i / side));
    ASSERT_TRUE(tools::writeHeights(path(name), file).ok());
  }
  /// As another encoder than the command line would.
  void writeStream(const tools::HeightFile& file, const std::string& name) {
    const tks_heights heights = tools::asHeights(file);
    tks_encode_options options = makeEncodeOptions();
    options.lossless = 1;
    const auto stream = tetrakis::encode(&heights, nullptr, options);
    ASSERT_TRUE(stream.ok()) << stream.status().message();
    ASSERT_TRUE(tools::writeBytes(path(name), std::as_bytes(stream->bytes())).ok());
  }
};

/// A CRS, a place, and the metres between samples there.
struct Placed {
  const char* crs;
  tools::GeoTransform place;
  double x, y;
};

TEST_F(CliPlace, TilesLieWhereTheirNamesSay) {
  struct Tile {
    const char* name;
    int north, east;
  };
  for (const auto& [name, north, east] :
       {Tile{"N46E007.hgt", 46, 7}, Tile{"n46w122.hgt", 46, -122}, Tile{"S34E018.hgt", -34, 18},
        Tile{"S01W071.hgt", -1, -71}, Tile{"N00E000.SRTMGL1.hgt", 0, 0}}) {
    SCOPED_TRACE(name);
    writeTile(name, 11);
    ASSERT_EQ(cli("-q encode " + std::string(name) + " --lossless -f -o s.tks").code, 0);
    const tools::GeoTransform wanted{east - 0.05, 0.1, 0, north + 1.05, 0, -0.1};
    const auto place = placeOf("s.tks", "heights");
    ASSERT_TRUE(place);
    for (size_t i = 0; i < 6; ++i) EXPECT_NEAR((*place)[i], wanted[i], 1e-12) << i;
    const Json info = Json::parse(cli("info --json s.tks").out)["heights"];
    EXPECT_EQ(info["registration"], "point");
    EXPECT_EQ(info["crs"], "EPSG:4326");
    // A tenth of a degree of the meridian, by the usual series for WGS 84.
    const double latitude = (north + 0.5) * 3.14159265358979 / 180;
    EXPECT_NEAR(
        info["spacing_y"],
        0.1 * (111132.92 - 559.82 * std::cos(2 * latitude) + 1.175 * std::cos(4 * latitude)), 0.01);
    std::string tile = std::string(name).substr(0, 7);
    for (char& c : tile) c = static_cast<char>(std::toupper(c));
    const Outcome other = cli("decode s.tks -f --height other.hgt");
    EXPECT_EQ(other.code, 0);
    EXPECT_NE(other.err.find("call this one " + tile), std::string::npos) << other.err;
  }
  for (const char* name : {"N46E0071.hgt", "tile.hgt", "N91E007.hgt", "S34E180.hgt"}) {
    writeTile(name, 11);
    ASSERT_EQ(cli("-q encode " + std::string(name) + " --lossless -f -o s.tks").code, 0) << name;
    EXPECT_FALSE(placeOf("s.tks", "heights")) << name;
  }
}

TEST_F(CliPlace, TilesLieWhereGdalReadsThem) {
  writeTile("S34W071.hgt", 1201);
  ASSERT_EQ(cli("-q encode S34W071.hgt --bytes 4k -o s.tks").code, 0);
  ASSERT_EQ(cli("decode s.tks --height o.tif").code, 0);
  const Json tile = gdalinfo("S34W071.hgt"), written = gdalinfo("o.tif");
  EXPECT_EQ(written["geoTransform"], tile["geoTransform"]);
  EXPECT_EQ(written["metadata"][""]["AREA_OR_POINT"], "Point");
  ASSERT_EQ(cli("decode s.tks --height back/S34W071.hgt").code, 2);
  std::filesystem::create_directory(folder() / "back");
  const Outcome back = cli("decode s.tks --height back/S34W071.hgt");
  EXPECT_EQ(back.err, "");
  EXPECT_EQ(gdalinfo("back/S34W071.hgt")["geoTransform"], tile["geoTransform"]);
  EXPECT_NE(cli("decode s.tks --window 0,0,100,100 --height p.hgt").err.find("a .tif can"),
            std::string::npos);
}

/// GDAL keeps beside a file what its format has no room for.
TEST_F(CliPlace, FilesOfGdalBesideAPictureSayWhereItLies) {
  ASSERT_TRUE(tools::writeHeights(path("h.png"), hills(9)).ok());
  write("h.png.aux.xml",
        "<PAMDataset><SRS dataAxisToSRSAxisMapping=\"1,2\">EPSG:32632</SRS>"
        "<GeoTransform> 5.0e+05, 3.0e+01, 0.0, 5.2e+06, 0.0, -2.5e+01</GeoTransform>"
        "<Metadata><MDI key=\"AREA_OR_POINT\">Point</MDI></Metadata>"
        "<PAMRasterBand band=\"1\"><NoDataValue>3</NoDataValue><UnitType>ft</UnitType>"
        "<Offset>7</Offset><Scale>0.5</Scale><Description>ground &amp; more</Description>"
        "</PAMRasterBand></PAMDataset>");
  ASSERT_EQ(cli("-q encode h.png --lossless -o s.tks").code, 0);
  const Json heights = Json::parse(cli("info --json s.tks").out)["heights"];
  EXPECT_EQ(heights["crs"], "EPSG:32632");
  EXPECT_EQ(heights["geotransform"], Json({5e5, 30, 0, 5.2e6, 0, -25}));
  EXPECT_EQ(heights["registration"], "point");
  EXPECT_EQ(heights["spacing_y"], 25);
  EXPECT_EQ(heights["nodata"], 3);
  EXPECT_EQ(heights["unit"], "ft");
  EXPECT_EQ(heights["offset"], 7);
  EXPECT_EQ(heights["scale"], 0.5);
  EXPECT_EQ(heights["description"], "ground & more");
  for (const char* broken : {"", "<PAMDataset>",
                             "<PAMDataset><GeoTransform>1,2</GeoTransform>"
                             "<SRS></SRS></PAMDataset>"}) {
    write("h.png.aux.xml", broken);
    EXPECT_EQ(cli("-q encode h.png --lossless -f -o s.tks").code, 0) << broken;
    EXPECT_FALSE(placeOf("s.tks", "heights")) << broken;
  }
}

TEST_F(CliPlace, SampleTerrainsLieInTheAlps) {
  for (const char* kind : {"mountains", "city", "voids"}) {
    ASSERT_EQ(cli(std::string("synth --size 18 -f -o s --kind ") + kind).code, 0);
    const Json info = gdalinfo("s/height.tif");
    const double spacing = info["geoTransform"][1];
    EXPECT_EQ(info["geoTransform"],
              Json({500000 - 9 * spacing, spacing, 0.0, 5200000 + 9 * spacing, 0.0, -spacing}));
    EXPECT_NE(info["coordinateSystem"]["wkt"].dump().find("UTM zone 32N"), std::string::npos);
    ASSERT_EQ(cli("-q encode s/height.tif --lossless -f -o s.tks").code, 0);
    EXPECT_EQ(Json::parse(cli("info --json s.tks").out)["heights"]["crs"], "EPSG:32632");
    EXPECT_EQ(cli("-q tiles s.tks -f -o t").code, 0) << kind;
  }
}

TEST_F(CliPlace, AuthoritiesAreWrittenInEitherCase) {
  ASSERT_EQ(cli("synth --size 17 -o s").code, 0);
  const auto crsOf = [this](const std::string& given) {
    EXPECT_EQ(
        cli("encode s/height.tif --crs " + given + " --lossless -f -o s.tks").err.find("PROJ"),
        std::string::npos);
    return Json::parse(cli("info --json s.tks").out)["heights"]["crs"];
  };
  EXPECT_EQ(crsOf("epsg:25832"), "EPSG:25832");
  EXPECT_EQ(cli("-q tiles s.tks -o t").code, 0);
  EXPECT_EQ(crsOf("esri:102014"), "ESRI:102014");
  EXPECT_EQ(crsOf("urn:ogc:def:crs:EPSG::25832"), "urn:ogc:def:crs:EPSG::25832");
}

TEST_F(CliPlace, WorldFilesAreReadAndWritten) {
  const std::string world = "10.5\n0\n0\n-10.25\n400005.25\n5300034.875\n";
  const tools::GeoTransform wanted{400000, 10.5, 0, 5300040, 0, -10.25};
  ASSERT_EQ(cli("synth --size 17 -o s").code, 0);
  for (const char* name : {"h.pgw", "h.PGW", "h.pngw", "h.wld"}) {
    std::filesystem::remove(path("h.png"));
    ASSERT_EQ(cli("-q encode s/height.tif --lossless -f -o p.tks").code, 0);
    ASSERT_EQ(cli("decode p.tks -f --height h.png").code, 0);
    std::filesystem::remove(path("h.pgw"));
    write(name, world);
    ASSERT_EQ(cli("-q encode h.png --crs EPSG:2227 --lossless -f -o s.tks").code, 0);
    std::filesystem::remove(path(name));
    EXPECT_EQ(placeOf("s.tks", "heights"), wanted) << name;
    const Json info = Json::parse(cli("info --json s.tks").out)["heights"];
    EXPECT_DOUBLE_EQ(info["spacing_x"], 10.5 * 1200 / 3937) << "survey feet";
  }
  ASSERT_EQ(cli("decode s.tks --height o.png").code, 0);
  EXPECT_EQ(content("o.pgw"), world);
  EXPECT_EQ(gdalinfo("o.png")["geoTransform"], Json(wanted));
  EXPECT_EQ(cli("decode s.tks --height o.png").code, 2) << "both exist";
  ASSERT_EQ(cli("decode s.tks --window 2,3,4,5 --height w.raw").code, 0);
  EXPECT_EQ(content("w.rww"), "10.5\n0\n0\n-10.25\n400026.25\n5300004.125\n");
}

TEST_F(CliPlace, WorldFilesPlaceTexturesOfAllFormats) {
  const tools::GeoTransform wanted{100, 2, 0.5, 900, 0.25, -2};
  for (const auto& [name, side] :
       {std::pair("t.png", "t.pgw"), {"t.jpg", "t.jgw"}, {"t.tif", "t.tfw"}, {"t.bmp", "t.bpw"}}) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(tools::writeImage(path(name), photo(20)).ok());
    write(side, "2\r\n0.25\r\n0.5\r\n-2\r\n101.25\r\n899.125\r\n");
    ASSERT_EQ(cli(std::string("-q encode --bytes 1k -f -o s.tks --texture ") + name).code, 0);
    EXPECT_EQ(placeOf("s.tks", "texture"), wanted);
    ASSERT_EQ(cli(std::string("decode s.tks -f --texture o-") + name).code, 0);
    EXPECT_EQ(gdalinfo(std::string("o-") + name)["geoTransform"], Json(wanted));
  }
}

/// A texture of 10 x 10 texels that begins 20 m east and 10 m south of 9 x 9 heights, turned by 90
/// degrees; beyond it its border.
TEST_F(CliPlace, MeshesPutTexturesWhereTheyLie) {
  ASSERT_TRUE(tools::writeHeights(path("h.png"), hills(9)).ok());
  ASSERT_TRUE(tools::writeImage(path("t.png"), photo(10)).ok());
  write("h.pgw", "10\n0\n0\n-10\n1005\n2005\n");
  const auto coordinates = [&] {
    EXPECT_EQ(cli("-q encode h.png --texture t.png --spacing 10 --lossless -f -o s.tks").code, 0);
    EXPECT_EQ(cli("-q decode s.tks -f --mesh m.obj").code, 0);
    std::vector<std::array<double, 4>> all;  // x, z, u, v
    std::istringstream lines(content("m.obj"));
    size_t textured = 0;
    for (std::string line; std::getline(lines, line);) {
      std::array<double, 4> at{};
      double height = 0;
      if (std::sscanf(line.c_str(), "v %lf %lf %lf", &at[0], &height, &at[1]) == 3)
        all.push_back(at);
      if (std::sscanf(line.c_str(), "vt %lf %lf", &at[2], &at[3]) == 2) {
        all[textured][2] = at[2];
        all[textured++][3] = 1 - at[3];
      }
    }
    EXPECT_EQ(textured, 81u);
    return all;
  };
  for (const auto& [x, z, u, v] : coordinates()) {
    EXPECT_NEAR(u, (x + 40) / 80, 1e-6);
    EXPECT_NEAR(v, (z + 40) / 80, 1e-6);
  }
  write("t.pgw", "0\n-5\n5\n0\n1022.5\n1997.5\n");  // columns go south, rows east
  for (const auto& [x, z, u, v] : coordinates()) {
    EXPECT_NEAR(u, std::clamp((z + 45 - 10) / 50, 0.0, 1.0), 1e-6) << x << ' ' << z;
    EXPECT_NEAR(v, std::clamp((x + 45 - 20) / 50, 0.0, 1.0), 1e-6) << x << ' ' << z;
  }
}

TEST_F(CliPlace, DegreesOfAWorldFileBecomeMetres) {
  ASSERT_TRUE(tools::writeHeights(path("h.png"), hills(9)).ok());
  write("h.pgw", "0.01\n0\n0\n-0.02\n7.005\n60.08\n");
  ASSERT_EQ(cli("-q encode h.png --crs EPSG:4326 --lossless -o s.tks").code, 0);
  const Json info = Json::parse(cli("info --json s.tks").out)["heights"];
  EXPECT_NEAR(info["spacing_x"], 0.01 * 55800.0, 0.01);
  EXPECT_NEAR(info["spacing_y"], 0.02 * 111412.2, 0.01);
}

TEST_F(CliPlace, ASpacingThatTheStreamLacksFollowsFromItsPlace) {
  tools::HeightFile file = hills(17);
  file.spacing_x = file.spacing_y = 0;
  for (const auto& [crs, place, x, y] :
       {Placed{"EPSG:32611", {400000, 10, 0, 3800000, 0, -20}, 10, 20},
        Placed{"EPSG:2263", {900000, 100, 0, 200000, 0, -100}, 30.48006096, 30.48006096},
        Placed{"EPSG:4326", {7, 0.01, 0, 60.17, 0, -0.02}, 558, 2228.244}}) {
    SCOPED_TRACE(crs);
    file.crs = crs;
    file.geotransform = place;
    writeStream(file, "s.tks");
    EXPECT_TRUE(Json::parse(cli("info --json s.tks").out)["heights"]["spacing_x"].is_null());
    const Outcome engine = cli("decode s.tks -f --height u.r16 --size unreal --json --mesh m.obj");
    ASSERT_EQ(engine.code, 0) << engine.err;
    EXPECT_EQ(engine.err.find("spacing"), std::string::npos) << engine.err;
    const Json ground = Json::parse(engine.out);
    EXPECT_NEAR(ground["width"], 16 * x, 0.01 * x);
    EXPECT_NEAR(ground["length"], 16 * y, 0.01 * y);
    double west = 0, north = 0;
    std::istringstream mesh(content("m.obj"));
    for (std::string row; std::getline(mesh, row);) {
      double east = 0, south = 0;
      if (std::sscanf(row.c_str(), "v %lf %*f %lf", &east, &south) != 2) continue;
      west = std::min(west, east);
      north = std::min(north, south);
    }
    EXPECT_NEAR(west, -8 * x, 0.01 * x);
    EXPECT_NEAR(north, -8 * y, 0.01 * y);
    const Json line = Json::parse(
        cliOf({"profile", "s.tks", "--line", "0,0 3,4", "--points", "9", "--json"}).out);
    EXPECT_EQ(line["distance_unit"], "m");
    EXPECT_NEAR(line["length"], std::hypot(3 * x, 4 * y), 0.01 * x);
  }
  file.crs = "a grid that nobody knows";
  writeStream(file, "s.tks");
  EXPECT_NE(cli("decode s.tks -f --mesh m.obj").err.find("counts as 30 m"), std::string::npos);
}

/// Of a building site: nowhere on Earth, but in a unit that WKT or the keys of a GeoTIFF state.
TEST_F(CliPlace, LocalGridsHaveTheSpacingOfTheirUnit) {
  struct Local {
    const char* crs;
    const char* keys;
    double metres;
  };
  constexpr double kSurveyFoot = 1200.0 / 3937;
  tools::HeightFile file = hills(17);
  file.spacing_x = file.spacing_y = 0;
  file.geotransform = tools::GeoTransform{0, 10, 0, 80, 0, -20};
  for (const auto& [crs, keys, metres] :
       {Local{"site grid", "1026=\"site grid\" 3076=9001", 1},
        Local{"site grid", "1024=32767 1026=\"site grid\" 3076=9002", 0.3048},
        Local{"site grid", "1026=\"site 3076=9001\" 3076=9003", kSurveyFoot},
        Local{"site grid", "1026=\"site grid\" 3076=32767 3077=20.1168", 20.1168},
        Local{"LOCAL_CS[\"site grid\",UNIT[\"metre\",1]]", "", 1},
        Local{"LOCAL_CS[\"site grid\",UNIT[\"US survey foot\",0.304800609601219]]", "",
              kSurveyFoot},
        Local{"ENGCRS[\"site grid\",EDATUM[\"\"],CS[Cartesian,2],AXIS[\"(E)\",east,ORDER[1],"
              "LENGTHUNIT[\"foot\",0.3048]],AXIS[\"(N)\",north,ORDER[2],LENGTHUNIT[\"foot\","
              "0.3048]]]",
              "", 0.3048},
        Local{"site grid", "1026=\"site grid\" 3076=32767 3077=0.017453292519943295", 0},
        Local{"site grid", "1024=3 3076=9001", 0}}) {
    SCOPED_TRACE(std::string(crs) + keys);
    file.crs = crs;
    file.geo_keys = keys;
    writeStream(file, "s.tks");
    const Json line = Json::parse(
        cliOf({"profile", "s.tks", "--line", "0,0 3,0", "--points", "9", "--json"}).out);
    EXPECT_EQ(line["distance_unit"], metres > 0 ? "m" : "samples");
    EXPECT_NEAR(line["length"], metres > 0 ? 30 * metres : 3, 1e-6);
    ASSERT_EQ(cli("-q decode s.tks -f --height h.tif").code, 0);
    ASSERT_EQ(cli("-q encode h.tif --lossless -f -o again.tks").code, 0);
    const Json info = Json::parse(cli("info --json again.tks").out)["heights"];
    EXPECT_EQ(info["spacing_x"].is_null(), metres == 0) << info;
    if (metres > 0) {
      EXPECT_NEAR(info["spacing_x"], 10 * metres, 1e-6);
      EXPECT_NEAR(info["spacing_y"], 20 * metres, 1e-6);
    }
  }
}

/// As old programs and those of other languages write them: GDAL, which judges, reads them too.
TEST_F(CliPlace, OddWorldFilesAreReadAsGdalDoes) {
  ASSERT_EQ(cli("synth --size 17 -o s").code, 0);
  ASSERT_EQ(cli("-q encode s/height.tif --lossless -f -o p.tks").code, 0);
  ASSERT_EQ(cli("decode p.tks -f --height h.png").code, 0);
  for (const char* text : {"10.5\r\n0\r\n0\r\n-10.25\r\n400005.25\r\n5300034.875\r\n\x1a",
                           "10.5\n0\n0\n-10.25\n400005.25\n5300034.875\x1a",
                           "10.5\n0\n0\n-10.25\n400005.25\n5300034.875\n17\nmade by hand\n",
                           "10,5\n0,0\n0\n-10,25\n400005,25\n5300034,875\n",
                           "\n 10.5 m\n\n+0\n0\n-1.025e1\n400005.25\n5300034.875"}) {
    write("h.pgw", text);
    ASSERT_EQ(cli("-q encode h.png --lossless -f -o s.tks").code, 0) << text;
    const auto place = placeOf("s.tks", "heights");
    ASSERT_TRUE(place) << text;
    EXPECT_EQ(Json(*place), gdalinfo("h.png")["geoTransform"]) << text;
  }
}

TEST_F(CliPlace, BrokenWorldFilesAreRefusedWithOneSentence) {
  ASSERT_TRUE(tools::writeHeights(path("h.png"), hills(9)).ok());
  for (const char* text :
       {"", "1\n2\n3\n4\n5", "1 2 3 4 5 6", "1\n0\n0\n-1\nnan\n0", "1\n0\n0\n-1\n1e300\n0",
        "0\n0\n0\n-1\n5\n0", "1\n0\n0\n-1\nx5\n0", "a map"}) {
    write("h.pgw", text);
    const Outcome run = cli("encode h.png --lossless -f -o s.tks");
    EXPECT_EQ(run.code, 2) << text;
    EXPECT_NE(run.err.find("a world file holds six numbers"), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1);
  }
}

TEST_F(CliPlace, NotesAskForWhatIsGuessed) {
  tools::HeightFile bare = hills(17);
  bare.spacing_x = bare.spacing_y = 0;
  bare.unit = "";
  ASSERT_TRUE(tools::writeHeights(path("bare.tif"), bare).ok());
  const auto asks = [this](const std::string& options, const char* option) {
    const auto outcome = cli("encode bare.tif -f -o a.tks " + options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err.find(std::string("give ") + option) != std::string::npos;
  };
  for (const char* blind : {"--lossless", "--bytes 1k", "--max-error 1"}) {
    EXPECT_FALSE(asks(blind, "--unit")) << blind;
    EXPECT_FALSE(asks(blind, "--spacing")) << blind;
  }
  EXPECT_TRUE(asks("--max-error 1ft", "--unit"));
  EXPECT_FALSE(asks("--max-error 1ft --unit m", "--unit"));
  EXPECT_FALSE(asks("--max-error 1ft", "--spacing"));
  EXPECT_TRUE(asks("--bytes 1k --triangles 50", "--spacing"));
  EXPECT_TRUE(asks("--bytes 1k --triangles 50", "--unit"));
  EXPECT_FALSE(asks("--bytes 1k --triangles 50 --spacing 10", "--spacing"));
}

TEST_F(CliPlace, AnUnknownCrsIsKeptWithANote) {
  ASSERT_EQ(cli("synth --size 17 -o s").code, 0);
  for (const auto& [crs, known] :
       {std::pair("EPSG:99999", false), {"nonsense", false}, {"EPSG:25832+5773", true}}) {
    const auto outcome =
        cli(std::string("encode s/height.tif --lossless -f -o a.tks --crs ") + crs);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err.find(std::string("does not know the CRS '") + crs) == std::string::npos,
              known);
    EXPECT_EQ(Json::parse(cli("info --json a.tks").out)["heights"]["crs"], crs);
  }
}

}  // namespace
}  // namespace tetrakis::test
