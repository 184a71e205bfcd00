// SPDX-License-Identifier: Apache-2.0
// Maps that files have in other ways than ours: other formats, sizes, places, and none at all.
#include <algorithm>

#include "apps/tools/files/meshes/surface_file.hpp"
#include "tests/cli/cli_material_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliOddMaterial : public MaterialTest {
 protected:
  /// What encoding tells.
  std::string encode(const std::string& mesh, const std::string& options = "--bytes 24k") {
    const Outcome run = cli("encode " + mesh + " --class triangles -f -o odd.tks " + options);
    EXPECT_EQ(run.code, 0) << run.err;
    return run.err;
  }
  json decodedMaterial() {
    EXPECT_EQ(cli("decode odd.tks --mesh out.glb --mesh-texture png -f").code, 0);
    return materialOf(glb("out.glb"));
  }
  /// An OBJ whose library has these lines.
  void writeObj(const std::string& library) {
    writeModel("odd.obj", sheet());
    write("odd.obj", "mtllib odd.mtl\nusemtl one\n" + content("odd.obj"));
    write("odd.mtl", "newmtl one\n" + library);
  }
  void save(const std::string& name, const ImageFile& image) {
    const auto bytes = tools::encodePng(image);
    ASSERT_TRUE(bytes.ok()) << bytes.status().message();
    ASSERT_TRUE(tools::writeBytes(path(name), *bytes).ok());
  }
  /// 8 bits as 16.
  static ImageFile widened(const ImageFile& image) {
    ImageFile wide = image;
    wide.sample = TKS_U16;
    wide.data.clear();
    for (const std::byte value : image.data) wide.data.insert(wide.data.end(), 2, value);
    return wide;
  }
  void expectNote(const std::string& note, const std::string& words) {
    EXPECT_NE(note.find(words), note.npos) << note;
  }
};

TEST_F(CliOddMaterial, ObjBringsItsOwnNames) {
  save("c.png", colours());
  save("n.png", widened(normals(24, 8)));
  save("r.png", shades());
  save("m.png", painted(48, 16, 1, [](double x, double, uint32_t) { return x > 0.5 ? 255 : 0; }));
  save("e.png", widened(lights()));
  writeObj("map_Kd c.png\nnorm n.png\nmap_Pr r.png\nmap_Pm m.png\nKe 0 0 0\nmap_Ke e.png\n");
  const std::string note = encode("odd.obj");
  expectNote(note, "taken along: normal 24 x 8, metallic_roughness 48 x 16, emissive 16 x 16\n");
  const json material = decodedMaterial(), surface = material["pbrMetallicRoughness"];
  const GlbParts out = glb("out.glb");
  EXPECT_LT(rmse(pictureOf(out, material["normalTexture"]), normals(24, 8)), 4);
  EXPECT_LT(rmse(pictureOf(out, material["emissiveTexture"]), lights()), 4);
  EXPECT_EQ(material["emissiveFactor"], json::array({1, 1, 1}));
  const ImageFile both = pictureOf(out, surface["metallicRoughnessTexture"]);
  ImageFile rough = both, metal = both;
  for (size_t at = 0; at < both.data.size(); at += 3) {
    rough.data[at] = rough.data[at + 2] = both.data[at + 1];
    metal.data[at] = metal.data[at + 1] = both.data[at + 2];
  }
  EXPECT_LT(rmse(rough, shades()), 4);
  EXPECT_EQ(surface["metallicFactor"], 1);
}

TEST_F(CliOddMaterial, EvenMapsBecomeFactors) {
  const auto even = [](double, double, uint32_t channel) { return channel == 1 ? 51.0 : 255.0; };
  const ImageFile image = colours(), dot = painted(1, 1, 3, even), plate = painted(8, 4, 3, even);
  tools::MeshFile mesh = sheet();
  mesh.texture = &image;
  mesh.maps.images = {&dot, &plate, &dot, &dot};
  mesh.maps.material.factors.emissive = {0.5, 0.5, 0.5};
  writeModel("odd.glb", mesh);
  const std::string note = encode("odd.glb");
  expectNote(note,
             "normal (it is the same all over), metallic_roughness (it is the same all over, "
             "and becomes factors), occlusion (it is the same all over), emissive (it is");
  EXPECT_TRUE(componentsOf("odd.tks").empty());
  const json material = decodedMaterial();
  EXPECT_FALSE(material.contains("extensions"));
  EXPECT_NEAR(material["pbrMetallicRoughness"]["roughnessFactor"], 0.2, 1e-6);
  EXPECT_EQ(material["pbrMetallicRoughness"]["metallicFactor"], 1);
  EXPECT_NEAR(material["emissiveFactor"][1], 0.5 * 0.0331, 1e-4);
  EXPECT_EQ(material["emissiveFactor"][0], 0.5);
}

TEST_F(CliOddMaterial, ObjGoesThereAndBack) {
  makeModel("model.glb");
  encode("model.glb");
  const Outcome run = cli("decode odd.tks --mesh out.obj");
  ASSERT_EQ(run.code, 0) << run.err;
  expectNote(run.err, "no place for the map of occlusion");
  for (const char* file : {"out.mtl", "out.png", "out_normal.png", "out_roughness.png",
                           "out_metallic.png", "out_emissive.png"})
    EXPECT_TRUE(names().contains(file)) << file;
  expectNote(encode("out.obj"),
             "taken along: normal 64 x 32, metallic_roughness 32 x 32, emissive 16 x 16\n");
  const json told = info("odd.tks")["material"];
  EXPECT_EQ(told["pbrMetallicRoughness"]["metallicFactor"], 0.25);
  EXPECT_EQ(told["emissiveFactor"], json::array({1, 0.5, 0.125}));
  EXPECT_EQ(cli("decode odd.tks --texture out_normal.png --mesh out.obj -f").code, 1);
  const Outcome ply = cli("decode odd.tks --mesh out.ply");
  EXPECT_EQ(ply.code, 0);
  expectNote(ply.err, "a .ply file has no place for maps");
}

TEST_F(CliOddMaterial, BumpsAreNormalsOnlyInColour) {
  save("bump.png", shades());
  writeObj("Kd 0.5 0.5 0.25\nmap_Bump bump.png\n");
  expectNote(encode("odd.obj"), "maps left out: normal (it holds heights of bumps");
  EXPECT_TRUE(componentsOf("odd.tks").empty());
  save("bump.png", normals());
  expectNote(encode("odd.obj"), "maps taken along: normal 64 x 32\n");
}

TEST_F(CliOddMaterial, AFileThatIsMissingOrTooLargeIsANote) {
  save("wide.png", painted(33000, 1, 1, [](double x, double, uint32_t) { return 255 * x; }));
  write("broken.png", "no picture");
  writeObj("map_Ke wide.png\nnorm lost.png\nmap_Pr broken.png\n");
  const std::string note = encode("odd.obj");
  expectNote(note, "normal (its file 'lost.png' is not there)");
  expectNote(note, "metallic_roughness (its file is not read: ");
  expectNote(note, "emissive (its file is not read: ");
  EXPECT_TRUE(componentsOf("odd.tks").empty());
}

TEST_F(CliOddMaterial, MapsGoWithoutAColourTexture) {
  const ImageFile normal = normals();
  tools::MeshFile mesh = sheet();
  mesh.maps.images[0] = &normal;
  writeModel("odd.glb", mesh);
  GlbParts parts = glb("odd.glb");
  parts.document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 0, 1};
  writeGlb("odd.glb", parts);
  expectNote(encode("odd.glb"), "maps taken along: normal 64 x 32\n");
  const json told = info("odd.tks");
  EXPECT_EQ(told["texture"]["width"], 1);
  const json material = decodedMaterial();
  const GlbParts out = glb("out.glb");
  const ImageFile colour = pictureOf(out, material["pbrMetallicRoughness"]["baseColorTexture"]);
  const std::array<int, 3> in_srgb = {188, 137, 0};
  for (size_t channel = 0; channel < 3; ++channel)
    EXPECT_NEAR(std::to_integer<int>(colour.data[channel]), in_srgb[channel], 2);
  EXPECT_LT(rmse(pictureOf(out, material["normalTexture"]), normal), 4);
}

TEST_F(CliOddMaterial, TexcoordsAreAsFineAsTheFinestMap) {
  const ImageFile normal = normals(512, 512);
  tools::MeshFile mesh = sheet();
  for (float& at : mesh.texcoords) at = 0.98F * at + 0.0037F;
  mesh.maps.images[0] = &normal;
  writeModel("odd.glb", mesh);
  encode("odd.glb", "--bytes 60k");
  EXPECT_EQ(cli("decode odd.tks --mesh out.glb").code, 0);
  const auto given = tools::readSurface(path("odd.glb")), got = tools::readSurface(path("out.glb"));
  ASSERT_TRUE(given.ok() && got.ok());
  float farthest = 0;  // from the next corner of those that there are
  for (const auto& at : got->texcoords) {
    float nearest = 1;
    for (const auto& one : given->texcoords)
      nearest = std::min(nearest, std::hypot(at[0] - one[0], at[1] - one[1]));
    farthest = std::max(farthest, nearest);
  }
  EXPECT_LT(farthest, 0.5F / 512);
}

TEST_F(CliOddMaterial, OnePictureOfThreeMapsIsCodedOnce) {
  const ImageFile image = colours(), surface = surfaces(200);
  tools::MeshFile mesh = sheet();
  mesh.texture = &image;
  mesh.maps.images[1] = &surface;
  mesh.maps.material.occlusion_is_red = true;
  writeModel("odd.glb", mesh);
  expectNote(encode("odd.glb"), "maps taken along: metallic_roughness 32 x 32\n");
  EXPECT_EQ(componentsOf("odd.tks").size(), 2u);
  const json material = decodedMaterial();
  const json slot = material["pbrMetallicRoughness"]["metallicRoughnessTexture"];
  EXPECT_EQ(material["occlusionTexture"]["index"], slot["index"]);
  EXPECT_LT(rmse(pictureOf(glb("out.glb"), slot), surface), 4);
  encode("odd.glb", "--bytes 24k --maps occlusion");
  EXPECT_TRUE(componentsOf("odd.tks").contains("occlusion"));
}

TEST_F(CliOddMaterial, MapsOnOtherTexcoordsAreLeftOut) {
  makeModel("odd.glb");
  GlbParts parts = glb("odd.glb");
  json& attributes = parts.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_1"] = attributes["TEXCOORD_0"];
  json& material = parts.document["materials"][0];
  material["occlusionTexture"]["texCoord"] = 1;
  material["normalTexture"]["extensions"]["KHR_texture_transform"]["scale"] = {2, 2};
  parts.document["extensionsUsed"] = {"KHR_texture_transform"};
  writeGlb("odd.glb", parts);
  const std::string note = encode("odd.glb");
  expectNote(note, "occlusion (it lies on other texture coordinates)");
  expectNote(note, "normal (the material moves it in a way of its own)");
  EXPECT_EQ(componentsOf("odd.tks").size(), 3u);
}

TEST_F(CliOddMaterial, ThoseOfMostTrianglesAreTaken) {
  makeModel("odd.glb");
  GlbParts parts = glb("odd.glb");
  json& primitives = parts.document["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives[1]["material"] = 1;
  json other = parts.document["materials"][0];
  other.erase("normalTexture");
  parts.document["materials"].push_back(other);
  writeGlb("odd.glb", parts);
  const std::string note = encode("odd.glb");
  expectNote(note, "1 part has other maps, which are left out");
  expectNote(note, "maps taken along: normal 64 x 32, ");
}

TEST_F(CliOddMaterial, AMeshWithoutTexcoordsHasNoMaps) {
  makeModel("odd.glb");
  GlbParts parts = glb("odd.glb");
  parts.document["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  writeGlb("odd.glb", parts);
  expectNote(encode("odd.glb"), "normal (the mesh has no texture coordinates)");
  EXPECT_EQ(cli("encode odd.glb --class triangles --bytes 9k --also a=odd.glb -o b.tks").code, 1);
}

}  // namespace
}  // namespace tetrakis::test
