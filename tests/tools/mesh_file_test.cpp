// SPDX-License-Identifier: Apache-2.0
// Meshes on disk, read back by Assimp: same triangles, same coordinates to the last bit.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "apps/tools/files/files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace tetrakis::tools {
namespace {

using test::ScratchFolder;

/// A hill over side x side vertices at odd coordinates that need all digits of a float.
MeshFile hill(uint32_t side) {
  MeshFile mesh;
  for (uint32_t row = 0; row < side; ++row) {
    for (uint32_t column = 0; column < side; ++column) {
      const float x = (float(column) - float(side) / 2) * 30.1F;
      const float z = (float(row) - float(side) / 2) * 24.7F;
      mesh.positions.insert(mesh.positions.end(), {x, 1000 * std::exp(-(x * x + z * z) / 1e5F), z});
      const float last = float(side - 1);
      mesh.texcoords.insert(mesh.texcoords.end(), {float(column) / last, float(row) / last});
    }
  }
  for (uint32_t row = 0; row + 1 < side; ++row) {
    for (uint32_t column = 0; column + 1 < side; ++column) {
      const uint32_t a = row * side + column, b = a + 1, c = a + side, d = c + 1;
      mesh.triangles.insert(mesh.triangles.end(), {a, c, b, b, c, d});
    }
  }
  return mesh;
}

ImageFile checkers(uint32_t channels, tks_sample sample) {
  ImageFile image{16, 8, channels, sample, {}};
  image.data.resize(16 * 8 * channels * tks_sample_bytes(sample));
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = std::byte((i / 8) % 2 * 200 + 20);
  return image;
}

/// Assimp rounds the decimals of an OBJ carelessly: the last bit may differ.
enum class Coordinates { kBinary, kDecimal };

/// Importers may split vertices: what counts is what stands at each corner of each triangle.
void expectSameCorners(const aiMesh& read, const MeshFile& written, Coordinates coordinates) {
  ASSERT_EQ(read.mNumFaces, written.triangles.size() / 3);
  for (size_t i = 0; i < written.triangles.size(); ++i) {
    const size_t vertex = written.triangles[i];
    const unsigned index = read.mFaces[i / 3].mIndices[i % 3];
    ASSERT_LT(index, read.mNumVertices);
    for (unsigned axis = 0; axis < 3; ++axis) {
      const float at = read.mVertices[index][axis], expected = written.positions[3 * vertex + axis];
      const float slack = coordinates == Coordinates::kBinary ? 0 : std::abs(expected) * 2e-7F;
      EXPECT_NEAR(at, expected, slack) << i;
    }
    if (written.texcoords.empty()) continue;
    const aiVector3D uv = read.mTextureCoords[0][index];  // counts from below
    EXPECT_NEAR(uv.x, written.texcoords[2 * vertex], 1e-7);
    EXPECT_NEAR(uv.y, 1 - written.texcoords[2 * vertex + 1], 1e-7);
  }
}

class MeshFormats : public ScratchFolder, public ::testing::WithParamInterface<const char*> {
 protected:
  std::string file() const { return path(std::string("mesh.") + GetParam()); }
  Coordinates coordinates() const {
    return GetParam() == std::string("obj") ? Coordinates::kDecimal : Coordinates::kBinary;
  }
};
INSTANTIATE_TEST_SUITE_P(All, MeshFormats, ::testing::Values("glb", "obj", "ply"),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST_P(MeshFormats, ComeBackExactly) {
  const ImageFile texture = checkers(3, TKS_U8);
  for (const uint32_t side : {2U, 3U, 40U}) {
    for (const bool textured : {false, true}) {
      SCOPED_TRACE(std::to_string(side) + (textured ? " textured" : " plain"));
      MeshFile mesh = hill(side);
      if (!textured) mesh.texcoords.clear();
      mesh.texture = textured ? &texture : nullptr;
      const Status written = writeMesh(file(), mesh);
      ASSERT_TRUE(written.ok()) << written.message();
      Assimp::Importer importer;
      const aiScene* scene = importer.ReadFile(file(), 0);
      ASSERT_NE(scene, nullptr) << importer.GetErrorString();
      ASSERT_EQ(scene->mNumMeshes, 1U);
      if (coordinates() == Coordinates::kBinary) {
        EXPECT_EQ(scene->mMeshes[0]->mNumVertices, mesh.positions.size() / 3);
      }
      EXPECT_EQ(scene->mMeshes[0]->HasTextureCoords(0), textured);
      expectSameCorners(*scene->mMeshes[0], mesh, coordinates());
    }
  }
}

TEST_P(MeshFormats, ExtremeCoordinatesComeBack) {
  MeshFile mesh = hill(2);
  mesh.texcoords.clear();
  using Limits = std::numeric_limits<float>;
  mesh.positions = {-0.1F, 1e-30F, 16777217.0F, 3.4e38F,     Limits::min(), -1e-7F,
                    1e9F,  -1e9F,  0.3F,        1.0F / 3.0F, 5e-5F,         -123456.789F};
  ASSERT_TRUE(writeMesh(file(), mesh).ok());
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file(), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  expectSameCorners(*scene->mMeshes[0], mesh, coordinates());
}

TEST_P(MeshFormats, InconsistentMeshesAreRefused) {
  const ImageFile texture = checkers(3, TKS_U8);
  std::vector<MeshFile> wrong(7, hill(3));
  wrong[0] = {};
  wrong[1].triangles.clear();
  wrong[2].triangles.back() = 9;
  wrong[3].triangles.pop_back();
  wrong[4].texcoords.pop_back();
  wrong[5].positions[4] = std::numeric_limits<float>::quiet_NaN();
  wrong[6].texcoords.clear();
  wrong[6].texture = &texture;
  for (const MeshFile& mesh : wrong) {
    EXPECT_EQ(writeMesh(file(), mesh).code(), TKS_USAGE);
    EXPECT_FALSE(std::filesystem::exists(file()));
  }
  EXPECT_EQ(writeMesh(path("missing/mesh"), hill(2), GetParam()).code(), TKS_IO);
}

class MeshFiles : public ScratchFolder {};

TEST_F(MeshFiles, UnknownMeshFormatsAreRefused) {
  EXPECT_EQ(writeMesh(path("a.stl"), hill(2)).code(), TKS_USAGE);
  EXPECT_EQ(writeMesh(path("a"), hill(2)).code(), TKS_USAGE);
}

TEST_F(MeshFiles, ObjDecimalsAreExact) {
  const MeshFile mesh = hill(40);
  ASSERT_TRUE(writeMesh(path("a.obj"), mesh).ok());
  std::ifstream file(path("a.obj"));
  std::vector<float> positions;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("v ")) continue;
    const char* at = line.c_str() + 1;
    for (int axis = 0; axis < 3; ++axis) {
      char* end = nullptr;
      positions.push_back(std::strtof(at, &end));
      at = end;
    }
  }
  EXPECT_EQ(positions, mesh.positions);
}

TEST_F(MeshFiles, ObjNamesItsTexture) {
  const ImageFile texture = checkers(4, TKS_U16);
  MeshFile mesh = hill(2);
  mesh.texture = &texture;
  ASSERT_TRUE(writeMesh(path("hill.obj"), mesh).ok());
  const auto read = readImage(path("hill.png"));
  ASSERT_TRUE(read.ok()) << read.status().message();
  EXPECT_TRUE(read->data == texture.data);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path("hill.obj"), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  aiString name;
  const aiMaterial* material = scene->mMaterials[scene->mMeshes[0]->mMaterialIndex];
  ASSERT_EQ(material->GetTexture(aiTextureType_DIFFUSE, 0, &name), aiReturn_SUCCESS);
  EXPECT_STREQ(name.C_Str(), "hill.png");
}

TEST_F(MeshFiles, ObjNamesTheAlphaOfItsTexture) {
  MeshFile mesh = hill(2);
  for (const bool opaque : {true, false}) {
    ImageFile texture{2, 1, 2, TKS_U8, std::vector<std::byte>(4, std::byte{100})};
    if (opaque) texture = {2, 1, 1, TKS_U8, std::vector<std::byte>(2, std::byte{100})};
    mesh.texture = &texture;
    ASSERT_TRUE(writeMesh(path("a.obj"), mesh).ok());
    std::ifstream file(path("a.mtl"));
    const std::string material(std::istreambuf_iterator<char>(file), {});
    EXPECT_EQ(material.find("map_d a.png\n") == material.npos, opaque) << material;
  }
}

TEST_F(MeshFiles, TexturesAreShownUpToTheirWhiteLevel) {
  ImageFile texture{4, 1, 1, TKS_U16, {}};
  const std::array<uint16_t, 4> samples{0, 500, 1000, 4000};
  const auto bytes = std::as_bytes(std::span(samples));
  texture.data.assign(bytes.begin(), bytes.end());
  texture.white_level = 1000;
  MeshFile mesh = hill(2);
  mesh.texture = &texture;
  ASSERT_TRUE(writeMesh(path("a.obj"), mesh).ok());
  const auto read = readImage(path("a.png"));
  ASSERT_TRUE(read.ok()) << read.status().message();
  const std::vector<std::byte> shown{std::byte{0}, std::byte{128}, std::byte{255}, std::byte{255}};
  EXPECT_TRUE(read->data == shown);
}

/// The JSON chunk of a binary glTF, after a look at the frame around it.
nlohmann::json documentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  const auto word = [&bytes](size_t at) {
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
  };
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(word(4), 2U);
  EXPECT_EQ(word(8), bytes.size());
  const uint32_t length = word(12);
  EXPECT_EQ(length % 4, 0U);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  EXPECT_EQ(word(20 + length) + 28 + length, bytes.size());
  EXPECT_EQ(bytes.substr(24 + length, 3), "BIN");
  return nlohmann::json::parse(bytes.substr(20, length));
}

TEST_F(MeshFiles, GlbTexturesAreJpegOrPng) {
  for (uint32_t channels = 1; channels <= 4; ++channels) {
    for (const tks_sample sample : {TKS_U8, TKS_U16}) {
      for (const bool opaque : {false, true}) {
        ImageFile texture = checkers(channels, sample);
        texture.opaque = opaque;
        MeshFile mesh = hill(3);
        mesh.texture = &texture;
        ASSERT_TRUE(writeMesh(path("a.glb"), mesh).ok());
        const auto document = documentOf(path("a.glb"));
        const bool jpeg = !texture.hasAlpha();
        EXPECT_EQ(document["images"][0]["mimeType"], jpeg ? "image/jpeg" : "image/png");
        EXPECT_EQ(document["materials"][0].contains("alphaMode"), texture.hasAlpha());
      }
    }
  }
}

TEST_F(MeshFiles, GlbBoundsAreExact) {
  const MeshFile mesh = hill(9);
  ASSERT_TRUE(writeMesh(path("a.glb"), mesh).ok());
  const auto document = documentOf(path("a.glb"));
  const auto& accessor = document["accessors"][0];
  for (size_t axis = 0; axis < 3; ++axis) {
    float low = mesh.positions[axis], high = low;
    for (size_t i = axis; i < mesh.positions.size(); i += 3) {
      low = std::min(low, mesh.positions[i]);
      high = std::max(high, mesh.positions[i]);
    }
    EXPECT_EQ(accessor["min"][axis].get<double>(), double{low});
    EXPECT_EQ(accessor["max"][axis].get<double>(), double{high});
  }
}

TEST_P(MeshFormats, NormalsPointUpAndHaveLengthOne) {
  MeshFile mesh = hill(9);
  mesh.positions.insert(mesh.positions.end(), {0, 0, 0});  // no triangle meets this vertex
  for (const bool textured : {false, true}) {
    if (!textured) mesh.texcoords.clear();
    if (textured) mesh.texcoords.resize(mesh.positions.size() / 3 * 2);
    ASSERT_TRUE(writeMesh(file(), mesh).ok());
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(file(), 0);
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    const aiMesh& read = *scene->mMeshes[0];
    ASSERT_TRUE(read.HasNormals());
    for (unsigned i = 0; i < read.mNumVertices; ++i) {
      EXPECT_NEAR(read.mNormals[i].Length(), 1, 1e-6);
      EXPECT_GT(read.mNormals[i].y, 0);
    }
  }
}

TEST_F(MeshFiles, GlbIndicesTake16BitsWhereTheyCan) {
  constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125;
  for (const size_t vertices : {9U, 65535U, 65536U}) {
    MeshFile mesh = hill(3);
    mesh.texcoords.clear();
    mesh.positions.resize(3 * vertices);
    mesh.triangles.insert(mesh.triangles.end(), {0, 1, static_cast<uint32_t>(vertices - 1)});
    ASSERT_TRUE(writeMesh(path("a.glb"), mesh).ok());
    const auto document = documentOf(path("a.glb"));
    const size_t indices = document["meshes"][0]["primitives"][0]["indices"];
    EXPECT_EQ(document["accessors"][indices]["componentType"],
              vertices <= 65535 ? kUnsignedShort : kUnsignedInt);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(path("a.glb"), 0);
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    expectSameCorners(*scene->mMeshes[0], mesh, Coordinates::kBinary);
  }
}

}  // namespace
}  // namespace tetrakis::tools
