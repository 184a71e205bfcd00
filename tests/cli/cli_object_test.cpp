// SPDX-License-Identifier: Apache-2.0
// Meshes of any shape through the command line: there, cut, and back again.
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/tools/files/meshes/surface_file.hpp"
#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

using namespace std::literals;

class CliObject : public CliTest {
 protected:
  /// A ball with bumps and a texture, blob.glb, blob.obj or blob.ply, and blob.tks, which resamples
  /// it; the tests of one process encode it once.
  void makeObject(const std::string& mesh, const std::string& options) {
    static std::map<std::string, std::pair<std::string, std::string>> made;
    ASSERT_EQ(cli("synth --kind blob --triangles 500 -o " + mesh).code, 0);
    const std::string key = mesh + ' ' + options;
    if (!made.contains(key)) {
      const Outcome run = cli("encode " + mesh + " --class resampled -o blob.tks " + options);
      ASSERT_EQ(run.code, 0) << run.err;
      made[key] = {content("blob.tks"), run.err};
    }
    write("blob.tks", made[key].first);
    note_ = made[key].second;
  }

  static tools::ImageFile plain(std::array<int, 3> colour) {
    tools::ImageFile image{4, 4, 3, TKS_U8, {}};
    for (int texel = 0; texel < 16; ++texel)
      for (const int value : colour) image.data.push_back(static_cast<std::byte>(value));
    return image;
  }

  nlohmann::json compared(const std::string& options) {
    const Outcome run = cli("compare blob.tks --json " + options);
    EXPECT_EQ(run.code, 0) << run.err;
    return nlohmann::json::parse(run.out, nullptr, false);
  }

  std::string note_;  ///< what encode told
};

TEST_F(CliObject, TexturedMeshesComeBack) {
  makeObject("blob.glb", "--bytes 6k");
  EXPECT_LE(content("blob.tks").size(), size_t{6} << 10);
  EXPECT_NE(note_.find("RMS distance to the mesh"), std::string::npos) << note_;
  for (const char* name : {"out.glb", "out.obj"}) {
    ASSERT_EQ(cli(std::string("decode blob.tks --mesh ") + name + " --triangles 2000").code, 0);
    const auto mesh = tools::readSurface(path(name));
    ASSERT_TRUE(mesh.ok()) << mesh.status().message();
    EXPECT_TRUE(mesh->texture.has_value());
    EXPECT_LE(mesh->triangles.size(), 2000u);
    EXPECT_GT(mesh->triangles.size(), 1500u);
    // Points of equal places are one, so that a closed surface of genus 0 has half of its triangles
    // and two more.
    EXPECT_EQ(mesh->points.size(), mesh->triangles.size() / 2 + 2);
  }
}

TEST_F(CliObject, MorePrefixMeansLessError) {
  makeObject("blob.glb", "--bytes 6k");
  double last = 1e9;
  for (const char* bytes : {"700", "1200", "2500", "6k"}) {
    const nlohmann::json figures = compared(std::string("--mesh blob.glb --bytes ") + bytes);
    EXPECT_LE(figures["rms_distance"], last) << bytes;
    last = figures["rms_distance"];
  }
  const nlohmann::json all = compared("--mesh blob.glb"),
                       coarse = compared("--mesh blob.glb --triangles 500");
  EXPECT_GT(all["surface_psnr"], 55);
  EXPECT_GT(all["colour_psnr"], 25);
  EXPECT_GT(coarse["rms_distance"], all["rms_distance"]);
  EXPECT_LE(coarse["triangles"], 500);
}

TEST_F(CliObject, AtlasGoesIntoAFileOfItsOwn) {
  makeObject("blob.glb", "--bytes 6k");
  ASSERT_EQ(cli("decode blob.tks --mesh out.obj --texture atlas.png").code, 0);
  EXPECT_EQ(content("atlas.png"), content("out.png"));
  ASSERT_EQ(cli("decode blob.tks --texture alone.png").code, 0);
  EXPECT_EQ(content("alone.png"), content("atlas.png"));
}

TEST_F(CliObject, ErrorsAreTargets) {
  makeObject("blob.ply", "--psnr 55 --unit cm");
  const nlohmann::json figures = compared("--mesh blob.ply");
  EXPECT_GT(figures["surface_psnr"], 54.5);
  EXPECT_LT(figures["surface_psnr"], 62);
  EXPECT_TRUE(figures["colour_psnr"].is_null());
  const std::string exact = "encode blob.ply --class resampled --max-error 0.1mm --unit cm";
  ASSERT_EQ(cli(exact + " -o b.tks").code, 0);
  EXPECT_EQ(nlohmann::json::parse(cli("info b.tks --json").out)["heights"]["max_error"], 0.01);
}

TEST_F(CliObject, TextureThatHasNoTargetIsLeftOutWithANote) {
  makeObject("blob.glb", "--psnr 50");
  EXPECT_NE(note_.find("the texture is left out"), std::string::npos) << note_;
  EXPECT_TRUE(nlohmann::json::parse(cli("info blob.tks --json").out)["texture"].is_null());
}

TEST_F(CliObject, GivenTextureReplacesThatOfTheMesh) {
  makeObject("blob.glb", "--bytes 6k");
  ASSERT_TRUE(tools::writeImage(path("red.png"), plain({200, 10, 10})).ok());
  ASSERT_EQ(cli("encode blob.glb --texture red.png --bytes 2k -o blob.tks -f").code, 0);
  EXPECT_GT(compared("--mesh blob.glb --texture red.png")["colour_psnr"], 40);
  EXPECT_LT(compared("--mesh blob.glb")["colour_psnr"], 20);
}

TEST_F(CliObject, PicturesShowLessErrorWithMoreBytes) {
  makeObject("blob.glb", "--bytes 6k");
  const nlohmann::json all = compared("--mesh blob.glb --pictures seen");
  EXPECT_GT(all["screen_psnr"], 25);
  EXPECT_FALSE(all["screen_exact"]);
  ASSERT_EQ(all["cameras"].size(), 14u);
  for (const char* name : {"seen/picture-14.png", "seen/original-14.png"})
    EXPECT_FALSE(content(name).empty()) << name;
  EXPECT_LT(compared("--mesh blob.glb --bytes 2k")["screen_psnr"], all["screen_psnr"]);
  const nlohmann::json one = compared("--mesh blob.glb --view top");
  ASSERT_EQ(one["cameras"].size(), 1u);
  EXPECT_EQ(one["cameras"][0]["name"], "top");
}

TEST_F(CliObject, BothKindsAreExplained) {
  ASSERT_EQ(cli("synth --kind blob --triangles 500 -o blob.glb").code, 0);
  const Outcome run = cli("encode blob.glb --bytes 6k -o b.tks --view around --explain --json");
  ASSERT_EQ(run.code, 0) << run.err;
  const nlohmann::json kinds = nlohmann::json::parse(run.out, nullptr, false);
  for (const char* kind : {"resampled", "triangles"}) {
    EXPECT_LE(kinds[kind]["bytes"], 6 << 10) << kind;
    EXPECT_GT(kinds[kind]["screen_psnr"], 20) << kind;
  }
  const bool triangles = kinds["triangles"]["screen_psnr"] > kinds["resampled"]["screen_psnr"];
  EXPECT_EQ(kinds["triangles"]["taken"], triangles);
  EXPECT_EQ(kinds["resampled"]["taken"], !triangles);
}

TEST_F(CliObject, InfoTellsOfTheBaseMesh) {
  makeObject("blob.glb", "--bytes 6k");
  const nlohmann::json info = nlohmann::json::parse(cli("info blob.tks --json").out);
  EXPECT_EQ(info["object"]["patches"], info["heights"]["forest"]["patches"]);
  EXPECT_EQ(info["object"]["samples_of_patch"], 17 * 17);
  EXPECT_EQ(info["heights"]["unit"], "m");
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_LT(info["object"]["base_from"][axis], info["object"]["base_to"][axis]);
}

TEST_F(CliObject, TrianglesStayAsTheyAre) {
  ASSERT_EQ(cli("synth --kind blob --triangles 500 -o blob.glb").code, 0);
  const Outcome run = cli("encode blob.glb --class triangles --bytes 12k -o blob.tks");
  ASSERT_EQ(run.code, 0) << run.err;
  const auto given = tools::readSurface(path("blob.glb"));
  const size_t triangles = given->triangles.size();
  EXPECT_NE(run.err.find(std::to_string(triangles) + " triangles; RMS"), std::string::npos);
  for (const char* name : {"out.glb", "out.obj"}) {
    ASSERT_EQ(cli(std::string("decode blob.tks --mesh ") + name).code, 0);
    const auto mesh = tools::readSurface(path(name));
    ASSERT_TRUE(mesh.ok()) << mesh.status().message();
    EXPECT_EQ(mesh->triangles.size(), triangles);
    EXPECT_EQ(mesh->points.size(), given->points.size());
    EXPECT_TRUE(mesh->texture.has_value());
    EXPECT_EQ(mesh->texture->width, given->texture->width);
  }
  const nlohmann::json info = nlohmann::json::parse(cli("info blob.tks --json").out);
  EXPECT_EQ(info["object"]["kind"], "triangles");
  EXPECT_EQ(info["object"]["triangles"], triangles);
  const nlohmann::json figures = compared("--mesh blob.glb");
  EXPECT_GT(figures["surface_psnr"], 70);
  EXPECT_GT(figures["colour_psnr"], 25);
  ASSERT_EQ(cli("decode blob.tks --mesh few.glb --triangles 100").code, 0);
  const auto few = tools::readSurface(path("few.glb"));
  ASSERT_TRUE(few.ok()) << few.status().message();
  EXPECT_LE(few->triangles.size(), 100u);
  EXPECT_GT(few->triangles.size(), 90u);
  EXPECT_TRUE(few->texture.has_value());
  EXPECT_LT(compared("--mesh blob.glb --triangles 100")["surface_psnr"], figures["surface_psnr"]);
}

TEST_F(CliObject, SketchesAreSeenAtOnce) {
  ASSERT_EQ(cli("synth --kind blob --triangles 1000 -o blob.glb").code, 0);
  const Outcome run =
      cli("encode blob.glb --class triangles --bytes 16k --sketch 1500 -o blob.tks");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("behind a sketch of 1"), std::string::npos) << run.err;
  EXPECT_LE(content("blob.tks").size(), size_t{16} << 10);
  const nlohmann::json info = nlohmann::json::parse(cli("info blob.tks --json").out);
  EXPECT_EQ(info["shows_sketch"], false);
  EXPECT_LT(info["least_bytes"], 1000);
  const std::string least = std::to_string(info["least_bytes"].get<int>());
  ASSERT_EQ(cli("truncate blob.tks --bytes 1600 -o cut.tks").code, 0);
  for (const std::string& early : {"cut.tks"s, "blob.tks --bytes " + least}) {
    const nlohmann::json cut = nlohmann::json::parse(cli("info --json " + early).out);
    EXPECT_EQ(cut["shows_sketch"], true) << early;
    EXPECT_EQ(cut["complete"], false);
    EXPECT_EQ(cut["stream_bytes"], info["stream_bytes"]);
    ASSERT_EQ(cli("decode --mesh early.glb -f --triangles 900 " + early).code, 0);
    EXPECT_LE(tools::readSurface(path("early.glb"))->triangles.size(), 900u);
  }
  EXPECT_GT(compared("--bytes 1600 --mesh blob.glb")["surface_psnr"], 45);
  EXPECT_NE(cli("verify cut.tks").code, 0);
  ASSERT_EQ(cli("encode blob.glb --class triangles --bytes 16k --sketch none -o no.tks").code, 0);
  const nlohmann::json none = nlohmann::json::parse(cli("info no.tks --json").out);
  EXPECT_EQ(none["least_bytes"], none["header_bytes"]);
  for (const char* wrong : {"often", "0", "-5", "16k"})
    EXPECT_EQ(cli(std::string("encode blob.glb --bytes 16k -o x.tks --sketch ") + wrong).code, 1)
        << wrong;
}

TEST_F(CliObject, OptionsOfTerrainAreRefused) {
  makeObject("blob.obj", "--bytes 2k");
  makeStream();
  const std::set<std::string> before = names();
  for (const char* arguments : {"encode blob.obj -o b.tks --lossless",
                                "encode blob.obj -o b.tks --bytes 2k --regions 64",
                                "encode blob.obj -o b.tks --bytes 2k --view low --engine rendered",
                                "encode blob.obj -o b.tks --bytes 2k --domain cube",
                                "encode blob.obj -o b.tks --bytes 2k --spacing 3",
                                "encode blob.obj -o b.tks --bytes 2k --crs EPSG:4326",
                                "encode blob.obj -o b.tks --bytes 2k --step 1",
                                "encode blob.obj -o b.tks --bytes 2k --triangles 100",
                                "encode blob.obj -o b.tks --bytes 2k --report r",
                                "encode blob.obj -o b.tks --psnr 50 --texture blob.png",
                                "encode blob.obj -o b.tks --bytes 9k --class quads",
                                "encode t.pgm -o b.tks --bytes 2k --class triangles",
                                "encode blob.obj -o b.tks --bytes 20",
                                "decode blob.tks --mesh b.glb --globe",
                                "decode blob.tks --mesh b.glb --view low",
                                "decode blob.tks --normal-map b.png",
                                "decode blob.tks --height b.r16 --size unreal",
                                "decode blob.tks --height b.tif --level 1",
                                "decode blob.tks --height b.tif --window 0,0,2,2",
                                "compare blob.tks --texture blob.png",
                                "compare blob.tks --mesh blob.obj --view sideways",
                                "encode blob.obj -o b.tks --psnr 50 --view around",
                                "compare a.tks --mesh blob.obj",
                                "plan blob.tks --channel 1M --renderer 1M",
                                "reorder blob.tks --view low -o b.tks",
                                "profile blob.tks --line 1,1,2,2 --points 3",
                                "tiles blob.tks -o b"}) {
    const Outcome run = cli(arguments);
    EXPECT_EQ(run.code, 1) << arguments << "\n" << run.err;
    EXPECT_TRUE(run.err.starts_with("tetrakis: ")) << arguments << "\n" << run.err;
    EXPECT_EQ(names(), before) << arguments;
  }
}

}  // namespace
}  // namespace tetrakis::test
