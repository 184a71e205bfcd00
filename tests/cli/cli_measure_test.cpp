// SPDX-License-Identifier: Apache-2.0
// What info, compare and the report say.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliMeasure : public CliTest {
 protected:
  nlohmann::json json(const std::string& arguments) {
    const Outcome run = cli(arguments + " --json");
    EXPECT_EQ(run.code, 0) << arguments << run.err;
    return nlohmann::json::parse(run.out, nullptr, false);
  }
};

TEST_F(CliMeasure, InfoTellsWhatWasEncoded) {
  makeInputs();
  ASSERT_EQ(cli("encode height.tif --texture texture.png --lossless -o a.tks --spacing 30,25 "
                "--vertical-datum EGM2008 --offset -5 --triangles 77")
                .code,
            0);
  const auto info = json("info a.tks");
  EXPECT_EQ(info["stream_bytes"], content("a.tks").size());
  EXPECT_EQ(info["complete"], true);
  EXPECT_EQ(info["lossless"], true);
  EXPECT_EQ(info["triangles"], 77);
  EXPECT_EQ(info["heights"]["width"], 17);
  EXPECT_EQ(info["heights"]["sample"], "u16");
  EXPECT_EQ(info["heights"]["scale"], 0.1);
  EXPECT_EQ(info["heights"]["offset"], -5);
  EXPECT_EQ(info["heights"]["spacing_y"], 25);
  EXPECT_EQ(info["heights"]["vertical_datum"], "EGM2008");
  EXPECT_EQ(info["texture"]["channels"], 3);
  EXPECT_EQ(json("info a.tks --bytes 300")["available_bytes"], 300);
  EXPECT_EQ(json("info a.tks --bytes 300")["complete"], false);
}

TEST_F(CliMeasure, LosslessComparesExact) {
  makeStream();
  const auto all = json("compare a.tks --height height.tif --texture texture.png --view all");
  EXPECT_EQ(all["bytes"], content("a.tks").size());
  EXPECT_EQ(all["triangles"], 2 * 16 * 16);
  EXPECT_EQ(all["height_rmse"], 0);
  EXPECT_EQ(all["height_max_error"], 0);
  for (const std::string what : {"height", "texture", "screen"}) {
    EXPECT_EQ(all[what + "_exact"], true) << what;
    EXPECT_TRUE(all[what + "_psnr"].is_null()) << what;
  }
  EXPECT_EQ(all["cameras"].size(), 3u);
}

TEST_F(CliMeasure, PrefixHasFiniteFigures) {
  makeStream(65);
  const auto cut =
      json("compare a.tks --bytes 1k --height height.tif --texture texture.png --view oblique");
  EXPECT_EQ(cut["bytes"], 1024);
  EXPECT_GT(cut["texture_psnr"], 3);
  EXPECT_GT(cut["screen_psnr"], 3);
  EXPECT_LT(cut["texture_psnr"], 60);
  EXPECT_LT(cut["screen_psnr"], 60);
  EXPECT_EQ(cut["screen_exact"], false);
  EXPECT_EQ(cut["cameras"][0]["screen_psnr"], cut["screen_psnr"]);
}

TEST_F(CliMeasure, WhatDoesNotApplyIsNull) {
  makeInputs();
  ASSERT_EQ(cli("encode --texture texture.png --lossless -o t.tks").code, 0);
  const auto texture = json("compare t.tks --texture texture.png");
  EXPECT_TRUE(texture["height_rmse"].is_null());
  EXPECT_TRUE(texture["triangles"].is_null());
  EXPECT_EQ(texture["texture_exact"], true);
  ASSERT_EQ(cli("encode height.tif --lossless -o h.tks").code, 0);
  EXPECT_TRUE(json("compare h.tks --height height.tif")["texture_psnr"].is_null());
}

/// A plane is the linear interpolant of any mesh, and its levels are planes where sides are powers
/// of two and 1: exact rasterisation has no error at all.
TEST_F(CliMeasure, MeshOfAPlaneHasNoError) {
  tools::HeightFile plane = hills(1);
  plane.width = 33, plane.height = 17;
  plane.scale = 1;
  plane.data.clear();
  for (uint32_t i = 0; i < 33 * 17; ++i)
    appendSample(plane, static_cast<uint16_t>(700 + 3 * (i % 33) + 11 * (i / 33)));
  ASSERT_TRUE(tools::writeHeights(path("plane.tif"), plane).ok());
  ASSERT_EQ(cli("encode plane.tif --lossless -o p.tks").code, 0);
  for (const char* triangles : {"8", "50", "1000"}) {
    const auto mesh =
        json("compare p.tks --height plane.tif --triangles " + std::string(triangles));
    EXPECT_LE(mesh["triangles"], std::max(8, std::stoi(triangles)));
    EXPECT_EQ(mesh["height_max_error"], 0) << triangles;
  }
}

TEST_F(CliMeasure, TrianglesBoundTheMeshAndMoreOfThemAreCloser) {
  makeStream(65);
  const std::string compare = "compare a.tks --height height.tif --triangles ";
  const auto coarse = json(compare + "100"), fine = json(compare + "2000");
  EXPECT_LE(coarse["triangles"], 100);
  EXPECT_LE(fine["triangles"], 2000);
  EXPECT_GT(coarse["height_rmse"], fine["height_rmse"]);
  EXPECT_GT(fine["height_rmse"], 0);
}

/// The same oblique camera looks at both meshes: only the second is made for it.
TEST_F(CliMeasure, MeshIsMadeForTheCamerasThatAreChosen) {
  ASSERT_EQ(cli("synth -o s --size 129").code, 0);
  ASSERT_EQ(cli("encode s/height.tif --texture s/texture.png --lossless -o a.tks").code, 0);
  const std::string compare =
      "compare a.tks --height s/height.tif --texture s/texture.png --triangles 1000";
  const auto map = json(compare), told = json(compare + " --view oblique");
  EXPECT_EQ(map["cameras"][0]["name"], told["cameras"][0]["name"]);
  EXPECT_LE(told["triangles"], 1000);
  EXPECT_GT(told["screen_psnr"].get<double>(), map["screen_psnr"].get<double>() + 1);
  EXPECT_GT(told["height_rmse"], map["height_rmse"]) << "a map has the least error of heights";
}

/// Which does not depend on whether the texture is judged, too.
TEST_F(CliMeasure, MeshForCamerasIsThatOfTheStreamsTexture) {
  makeStream(65);
  const std::string compare = "compare a.tks --height height.tif --triangles 300 --view low";
  EXPECT_EQ(json(compare)["height_rmse"], json(compare + " --texture texture.png")["height_rmse"]);
}

TEST_F(CliMeasure, PicturesCountByTheWeightsOfTheirCameras) {
  makeStream(65);
  const std::string from = R"({"target": [0,400,0], "eye": )";
  const auto compareWith = [&](const std::string& weights) {
    write("cameras.json", R"({"cameras": [)" + from + R"([0,1500,1500], "weight": )" + weights +
                              "}, " + from + R"([300,900,0], "weight": 1}]})");
    return json(
        "compare a.tks --bytes 1k --height height.tif --texture texture.png "
        "--cameras cameras.json");
  };
  const auto squares = [](const nlohmann::json& seen) {
    return std::pow(10, -seen["screen_psnr"].get<double>() / 10);
  };
  const auto heavy = compareWith("3");
  const double first = squares(heavy["cameras"][0]), second = squares(heavy["cameras"][1]);
  ASSERT_GT(std::abs(first / second - 1), 0.01) << "else weights cannot show";
  EXPECT_NEAR(squares(heavy) / ((3 * first + second) / 4), 1, 1e-9);
  EXPECT_NEAR(squares(compareWith("0")) / second, 1, 1e-9);
  EXPECT_NEAR(squares(compareWith("1e308")) / first, 1, 1e-9);
}

TEST_F(CliMeasure, CamerasWithoutWeightsCannotJudge) {
  makeStream();
  write("none.json", R"({"cameras": [{"eye": [0,900,900], "target": [0,0,0], "weight": 0}]})");
  const Outcome run = cli("compare a.tks --height height.tif --cameras none.json");
  EXPECT_EQ(run.code, 1);
  EXPECT_NE(run.err.find("no camera has a weight above 0"), std::string::npos) << run.err;
}

TEST_F(CliMeasure, MaxErrorHoldsInTheUnitAsked) {
  makeInputs(65);
  for (const char* bound : {"2", "2m", "200cm", "6.5ft"}) {
    ASSERT_EQ(cli("encode height.tif -f -o a.tks --max-error " + std::string(bound)).code, 0);
    EXPECT_LE(json("compare a.tks --height height.tif")["height_max_error"], 2.0) << bound;
  }
}

TEST_F(CliMeasure, PicturesOfAllCameras) {
  makeInputs(65);
  ASSERT_EQ(cli("encode height.tif --texture texture.png --lossless -o whole.tks").code, 0);
  const std::string compare = "compare whole.tks --height height.tif --texture texture.png ";
  const auto outcome = cli(compare + "--view all --pictures seen");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string camera : {"1", "2", "3"}) {
    const std::string picture = content("seen/picture-" + camera + ".png");
    EXPECT_GT(picture.size(), 1000u);
    EXPECT_EQ(picture, content("seen/original-" + camera + ".png"));
  }
  EXPECT_NE(content("seen/picture-1.png"), content("seen/picture-3.png"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("seen")), {}), 6);
  EXPECT_EQ(cli(compare + "--pictures seen").code, 2);
  EXPECT_EQ(cli(compare + "--bytes 2k --pictures seen -f").code, 0);
  EXPECT_NE(content("seen/picture-1.png"), content("seen/original-1.png"));
  // What cannot be measured leaves no folder behind.
  EXPECT_EQ(cli("compare whole.tks --height texture.png --pictures none").code, 1);
  EXPECT_FALSE(names().contains("none"));
}

TEST_F(CliMeasure, OtherReferencesFail) {
  makeStream();
  ASSERT_TRUE(tools::writeHeights(path("larger.tif"), hills(18)).ok());
  tools::HeightFile changed = hills(17);
  changed.data[40] ^= std::byte{1};
  ASSERT_TRUE(tools::writeHeights(path("changed.tif"), changed).ok());
  EXPECT_EQ(cli("compare a.tks --height larger.tif").code, 7);
  const auto outcome = cli("compare a.tks --height changed.tif");
  EXPECT_EQ(outcome.code, 7);
  EXPECT_NE(outcome.err.find("it is not of this file, or broke its promise"), std::string::npos);
  tools::HeightFile floats = hills(17);
  floats.sample = TKS_F32;
  floats.data.resize(sizeof(float) * 17 * 17);
  ASSERT_TRUE(tools::writeHeights(path("floats.tif"), floats).ok());
  const auto other = cli("compare a.tks --height floats.tif");
  EXPECT_EQ(other.code, 7);
  EXPECT_NE(other.err.find("17 x 17 heights of u16, the reference 17 x 17 heights of f32"),
            std::string::npos)
      << other.err;
  ASSERT_TRUE(tools::writeImage(path("other.png"), photo(33)).ok());
  EXPECT_EQ(cli("compare a.tks --texture other.png").code, 7);
}

TEST_F(CliMeasure, ReportIsOnePageWithItsPicturesInside) {
  makeInputs(65);
  const std::string encode =
      "encode height.tif --texture texture.png --bytes 16k --view all -q -f -o a.tks --report r";
  ASSERT_EQ(cli(encode).code, 0);
  const std::string page = content("r/index.html");
  size_t pictures = 0;
  for (size_t at = page.find("<img"); at != std::string::npos; at = page.find("<img", at + 1))
    ++pictures;
  EXPECT_EQ(pictures, 3u * (1 + 5) + 2);  // and those of the slider
  EXPECT_NE(page.find("d3js.org"), std::string::npos);
  EXPECT_NE(page.find("\"greedy\":[{"), std::string::npos);
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_EQ(page.find("href=\"http"), std::string::npos);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("r")), {}), 1);
  EXPECT_EQ(cli("encode height.tif --lossless -o b.tks --report r").code, 2);
  EXPECT_FALSE(names().contains("b.tks"));
}

TEST_F(CliMeasure, ReportOfATextureAlone) {
  makeInputs(65);
  ASSERT_EQ(cli("encode --texture texture.png --bytes 8k -o t.tks --report r").code, 0);
  EXPECT_NE(content("r/index.html").find("<img"), std::string::npos);
  EXPECT_NE(content("r/index.html").find("\"plane\":null"), std::string::npos);
}

}  // namespace
}  // namespace tetrakis::test
