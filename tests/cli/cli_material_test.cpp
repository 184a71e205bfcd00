// SPDX-License-Identifier: Apache-2.0
// Maps of a material through the command line: there, cut, and back in their slots.
#include <algorithm>
#include <cstdlib>
#include <vector>

#include "tests/cli/cli_material_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliMaterial : public MaterialTest {
 protected:
  /// model.glb with all maps, and model.tks.
  std::string makeStream(const std::string& options = "--bytes 24k") {
    makeModel("model.glb");
    const Outcome run = cli("encode model.glb --class triangles -f -o model.tks " + options);
    EXPECT_EQ(run.code, 0) << run.err;
    return run.err;
  }
  /// Vertices of the sheet lie where x and z are their places on the image that they show.
  void expectPlacesShow(const GlbParts& out, const ImageFile& atlas, const ImageFile& image,
                        uint32_t channel) {
    const std::vector<float> points = floatsOf(out, "POSITION"),
                             places = floatsOf(out, "TEXCOORD_0");
    ASSERT_EQ(points.size() / 3, places.size() / 2);
    const auto texelAt = [&](const ImageFile& of, double x, double y) {
      const auto inside = [](double at, uint32_t side) {
        return static_cast<size_t>(std::clamp(at * side, 0.0, side - 1.0));
      };
      const size_t texel = inside(y, of.height) * of.width + inside(x, of.width);
      const uint32_t of_channel = of.channels == 1 ? 0 : channel;
      return std::to_integer<int>(of.data[texel * of.channels + of_channel]);
    };
    size_t off = 0;
    for (size_t v = 0; v < points.size() / 3; ++v) {
      const int shown = texelAt(atlas, places[2 * v], places[2 * v + 1]);
      off += std::abs(shown - texelAt(image, points[3 * v], points[3 * v + 2])) > 24;
    }
    EXPECT_LT(off, points.size() / 3 / 10);
  }
  GlbParts decoded(const std::string& options = "") {
    const Outcome run = cli("decode model.tks --mesh out.glb -f --mesh-texture png " + options);
    EXPECT_EQ(run.code, 0) << options << run.err;
    return glb("out.glb");
  }
};

TEST_F(CliMaterial, MapsComeBackEachInItsSlot) {
  const std::string note = makeStream();
  EXPECT_NE(note.find("note: maps taken along: normal 64 x 32, metallic_roughness 32 x 32, "
                      "occlusion 48 x 16, emissive 16 x 16\n"),
            note.npos)
      << note;
  EXPECT_LE(content("model.tks").size(), size_t{24} << 10);
  EXPECT_EQ(cli("verify model.tks").code, 0);
  const GlbParts out = decoded();
  const json material = materialOf(out), surface = material["pbrMetallicRoughness"];
  EXPECT_FALSE(material.contains("extensions"));
  EXPECT_LT(rmse(pictureOf(out, surface["baseColorTexture"]), colours()), 4);
  EXPECT_LT(rmse(pictureOf(out, material["normalTexture"]), normals()), 4);
  EXPECT_LT(rmse(pictureOf(out, surface["metallicRoughnessTexture"]), surfaces(), 1), 4);
  EXPECT_LT(rmse(pictureOf(out, material["occlusionTexture"]), shades()), 4);
  EXPECT_LT(rmse(pictureOf(out, material["emissiveTexture"]), lights()), 4);
}

TEST_F(CliMaterial, FactorsComeBack) {
  makeStream();
  const json material = materialOf(decoded()), surface = material["pbrMetallicRoughness"];
  EXPECT_EQ(surface["metallicFactor"], 0.25);
  EXPECT_EQ(surface["roughnessFactor"], 0.75);
  EXPECT_EQ(material["emissiveFactor"], json::array({1, 0.5, 0.125}));
  EXPECT_EQ(material["normalTexture"]["scale"], 0.5);
  EXPECT_EQ(material["occlusionTexture"]["strength"], 0.875);
  EXPECT_EQ(material["doubleSided"], true);
  const json told = info("model.tks")["material"];
  EXPECT_EQ(told["pbrMetallicRoughness"]["roughnessFactor"], 0.75);
  ASSERT_EQ(cli("truncate model.tks --bytes 5k -o cut.tks").code, 0);
  EXPECT_EQ(info("cut.tks")["material"], told);
}

TEST_F(CliMaterial, EachComponentIsTheMapOfTheMesh) {
  makeStream();
  const GlbParts out = decoded();
  const json material = materialOf(out);
  ASSERT_EQ(cli("decode model.tks --component normal --texture normal.png").code, 0);
  const auto alone = tools::readImage(path("normal.png"));
  ASSERT_TRUE(alone.ok());
  EXPECT_EQ(rmse(pictureOf(out, material["normalTexture"]), *alone), 0);
  const GlbParts shown = decoded("--component normal");  // in the place of the colours, alone
  const json plain = materialOf(shown);
  EXPECT_FALSE(plain.contains("normalTexture"));
  EXPECT_EQ(rmse(pictureOf(shown, plain["pbrMetallicRoughness"]["baseColorTexture"]), *alone), 0);
}

TEST_F(CliMaterial, EveryPrefixHasTheMapsThatItKnows) {
  makeStream();
  const json told = info("model.tks");
  const uint64_t header = told["header_bytes"], all = content("model.tks").size();
  size_t last = 0;
  double error = HUGE_VAL;
  for (uint64_t cut = header; cut <= all; cut += std::max<uint64_t>(1, (all - header) / 12)) {
    const GlbParts out = decoded("--bytes " + std::to_string(cut));
    const json material = materialOf(out), surface = material["pbrMetallicRoughness"];
    const bool has_surface = surface.contains("metallicRoughnessTexture");
    EXPECT_EQ(surface["roughnessFactor"], has_surface ? 0.75 : 1) << cut;
    EXPECT_EQ(material.contains("emissiveFactor"), material.contains("emissiveTexture")) << cut;
    size_t maps = has_surface;
    for (const char* name : {"normalTexture", "occlusionTexture", "emissiveTexture"})
      maps += material.contains(name);
    EXPECT_GE(maps, last) << cut;
    EXPECT_EQ(maps > 0, cut > header) << cut;
    last = maps;
    if (!material.contains("normalTexture")) continue;
    const double now = rmse(pictureOf(out, material["normalTexture"]), normals());
    EXPECT_LE(now, error * 1.02) << cut;
    error = now;
  }
  EXPECT_EQ(last, 4u);
}

TEST_F(CliMaterial, MapsComeBehindASketch) {
  makeStream("--bytes 24k --sketch 1500");
  const json told = info("model.tks");
  const std::string short_of_it = "--bytes " + std::to_string(told["header_bytes"].get<int>() - 1);
  const json sketch = info("model.tks " + short_of_it);
  EXPECT_EQ(sketch["shows_sketch"], true);
  EXPECT_TRUE(sketch["material"].is_null());
  EXPECT_TRUE(materialOf(decoded(short_of_it)).contains("extensions"));
  EXPECT_EQ(told["shows_sketch"], false);
  EXPECT_TRUE(materialOf(decoded()).contains("normalTexture"));
  EXPECT_EQ(cli("verify model.tks").code, 0);
  EXPECT_LE(content("model.tks").size(), size_t{24} << 10);
}

TEST_F(CliMaterial, DamageEndsInASentenceOrAMesh) {
  makeStream("--bytes 6k");
  const std::string whole = content("model.tks");
  const uint64_t header = info("model.tks")["header_bytes"];
  for (size_t i = 0; i < 24; ++i) {
    std::string damaged = whole;
    damaged[header + i * 7919 % (whole.size() - header)] ^= static_cast<char>(1 << i % 8);
    write("model.tks", damaged.substr(0, i % 2 ? damaged.size() : damaged.size() - 1));
    const Outcome run = cli("decode model.tks --mesh out.glb -f");
    EXPECT_TRUE(run.code == 0 || run.err.size() > 20) << run.code;
  }
}

TEST_F(CliMaterial, WhatIsNotWantedIsLeftOut) {
  makeStream("--bytes 12k --maps none");
  const std::string without = content("model.tks");
  EXPECT_TRUE(componentsOf("model.tks").empty());
  tools::MeshFile mesh = sheet();
  const ImageFile image = colours();
  mesh.texture = &image;
  writeModel("model.glb", mesh);
  ASSERT_EQ(cli("encode model.glb --class triangles --bytes 12k -f -o plain.tks").code, 0);
  EXPECT_TRUE(without == content("plain.tks"));
  const std::string note = makeStream("--bytes 12k --maps normal,occlusion");
  EXPECT_NE(note.find("left out: metallic_roughness (--maps), emissive (--maps)\n"), note.npos);
  EXPECT_EQ(componentsOf("model.tks").size(), 3u);
  const json material = materialOf(decoded());
  EXPECT_EQ(material["pbrMetallicRoughness"]["metallicFactor"], 0);
  EXPECT_FALSE(material.contains("emissiveFactor"));
  EXPECT_EQ(material["normalTexture"]["scale"], 0.5);
}

TEST_F(CliMaterial, MapsNeedANumberOfBytes) {
  const std::string note = makeStream("--psnr 50");
  EXPECT_NE(note.find("the texture and other maps are left out: they go with --bytes alone"),
            note.npos)
      << note;
}

/// An atlas of a map is laid out as that of the texture, so that both have one set of places.
TEST_F(CliMaterial, MapsLieOnPatchesOfAResampledObject) {
  makeModel("model.glb");
  const Outcome run = cli("encode model.glb --class resampled --bytes 40k -o model.tks");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("note: maps taken along: metallic_roughness 32 x 32, occlusion 48 x 16, "
                         "emissive 16 x 16; left out: normal (it counts from texture coordinates"),
            run.err.npos)
      << run.err;
  EXPECT_EQ(cli("verify model.tks").code, 0);
  EXPECT_LE(content("model.tks").size(), size_t{40} << 10);
  const GlbParts out = decoded();
  const json material = materialOf(out), surface = material["pbrMetallicRoughness"];
  EXPECT_FALSE(material.contains("normalTexture"));
  EXPECT_EQ(surface["roughnessFactor"], 0.75);
  EXPECT_EQ(material["emissiveFactor"], json::array({1, 0.5, 0.125}));
  const ImageFile colour = pictureOf(out, surface["baseColorTexture"]);
  const ImageFile rough = pictureOf(out, surface["metallicRoughnessTexture"]);
  const ImageFile shade = pictureOf(out, material["occlusionTexture"]);
  EXPECT_EQ(rough.width, colour.width);
  EXPECT_EQ(shade.height, colour.height);
  EXPECT_EQ(pictureOf(out, material["emissiveTexture"]).width, colour.width);
  expectPlacesShow(out, rough, surfaces(), 1);
  expectPlacesShow(out, shade, shades(), 0);
}

TEST_F(CliMaterial, EveryPrefixOfAResampledObjectHasTheMapsThatItKnows) {
  makeModel("model.glb");
  ASSERT_EQ(cli("encode model.glb --class resampled --bytes 8k -o model.tks").code, 0);
  const uint64_t header = info("model.tks")["header_bytes"];
  size_t last = 0;
  for (uint64_t cut = header; cut <= 8192; cut += (8192 - header) / 9) {
    const json material = materialOf(decoded("--bytes " + std::to_string(cut)));
    size_t maps = material["pbrMetallicRoughness"].contains("metallicRoughnessTexture");
    for (const char* name : {"occlusionTexture", "emissiveTexture"})
      maps += material.contains(name);
    EXPECT_GE(maps, last) << cut;
    last = maps;
  }
  EXPECT_EQ(last, 3u);
}

/// Of glTF alone: other formats have factors that nobody fills in.
TEST_F(CliMaterial, FactorsComeBackWithoutMaps) {
  tools::MeshFile mesh = sheet();
  mesh.maps.is_lit = true;
  tools::MaterialFactors& factors = mesh.maps.material.factors;
  factors = {0.25, 0.5, {0, 0, 0.5}, 1, 1, true};
  factors.colour = {0.5, 0.25, 1, 0.75};
  factors.alpha_mode = tools::AlphaMode::kBlend;
  writeModel("model.glb", mesh);
  for (const char* kind :
       {"triangles --psnr 50", "resampled --bytes 2000", "resampled --psnr 40"}) {
    ASSERT_EQ(cli("encode model.glb -f -o model.tks --class " + std::string(kind)).code, 0) << kind;
    const json material = materialOf(decoded()), surface = material["pbrMetallicRoughness"];
    EXPECT_EQ(surface["metallicFactor"], 0.25) << kind;
    EXPECT_EQ(surface["roughnessFactor"], 0.5) << kind;
    EXPECT_EQ(surface["baseColorFactor"], json::array({0.5, 0.25, 1, 0.75})) << kind;
    EXPECT_EQ(material["emissiveFactor"], json::array({0, 0, 0.5})) << kind;
    EXPECT_EQ(material["alphaMode"], "BLEND") << kind;
    EXPECT_EQ(material["doubleSided"], true) << kind;
  }
  EXPECT_LE(content("model.tks").size(), 2000u);
  factors.alpha_mode = tools::AlphaMode::kMask;
  factors.alpha_cutoff = 0.25;
  writeModel("model.glb", mesh);
  ASSERT_EQ(cli("encode model.glb --bytes 2000 -f -o model.tks").code, 0);
  EXPECT_EQ(materialOf(decoded())["alphaCutoff"], 0.25);
  mesh.maps = {};  // unlit, as terrain is
  const ImageFile image = colours();
  mesh.texture = &image;
  writeModel("model.glb", mesh);
  ASSERT_EQ(cli("encode model.glb --bytes 9k -f -o model.tks").code, 0);
  EXPECT_TRUE(info("model.tks")["material"].is_null());
}

TEST_F(CliMaterial, WeightsMoveBytes) {
  makeStream("--bytes 2k");
  const uint64_t usual = componentsOf("model.tks")["normal"];
  makeStream("--bytes 2k --also-weight normal=50");
  EXPECT_GT(componentsOf("model.tks")["normal"], usual + usual / 4);
  EXPECT_EQ(
      cli("encode model.glb --class triangles --bytes 2k --also-weight gloss=2 -o n.tks").code, 1);
}

TEST_F(CliMaterial, FurtherTexturesLieOnTriangles) {
  makeStream();
  ASSERT_TRUE(tools::writeImage(path("wear.png"), shades()).ok());
  ASSERT_TRUE(tools::writeImage(path("flat.png"), normals(8, 8)).ok());
  const std::string also =
      " --bytes 24k --also wear=wear.png --also normal=flat.png -f -o model.tks";
  ASSERT_EQ(cli("encode model.glb --class triangles" + also).code, 0);
  const auto components = componentsOf("model.tks");
  EXPECT_EQ(components.size(), 6u);
  EXPECT_TRUE(components.contains("wear"));
  const GlbParts out = decoded();
  EXPECT_EQ(pictureOf(out, materialOf(out)["normalTexture"]).width, 8u);
  ASSERT_EQ(cli("encode model.glb --class resampled" + also).code, 0);
  EXPECT_TRUE(componentsOf("model.tks").contains("wear"));
}

TEST_F(CliMaterial, OptionsThatMeanNothingAreRefused) {
  makeModel("model.glb");
  makeInputs();
  for (const char* arguments :
       {"encode model.glb --bytes 9k --maps gloss -o b.tks",
        "encode model.glb --bytes 9k --maps  "
        "normal,,emissive -o b.tks",
        "encode height.tif --bytes 9k --maps none -o b.tks",
        "encode height.tif --bytes 9k --also-weight a=1 -o b.tks",
        "encode model.glb --psnr 50 --also a=texture.png --class triangles -o b.tks"}) {
    const Outcome run = cli(arguments);
    EXPECT_EQ(run.code, 1) << arguments;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
}

}  // namespace
}  // namespace tetrakis::test
