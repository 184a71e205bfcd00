// SPDX-License-Identifier: Apache-2.0
// Compressed GLBs, decoded by the libraries that other programs use: the triangles of the
// uncompressed mesh, with coordinates within the quantisation that is promised.
#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/tools/compression/mesh_arrays.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/files.hpp"
#include "tests/support/scratch_folder.hpp"

namespace tetrakis::tools {
namespace {

using nlohmann::json;
using test::ScratchFolder;

struct ReadMesh {
  std::vector<float> positions, normals, texcoords;
  std::vector<uint32_t> triangles;
};

struct GlbContent {
  json document;
  std::vector<std::byte> binary;

  std::span<const std::byte> view(const json& place) const {
    return std::span(binary).subspan(place.value("byteOffset", size_t{0}),
                                     place["byteLength"].get<size_t>());
  }
  const json& primitive() const { return document["meshes"][0]["primitives"][0]; }
};

GlbContent readGlb(const std::string& path) {
  const auto bytes = readBytes(path);
  EXPECT_TRUE(bytes.ok());
  uint32_t length = 0;
  std::memcpy(&length, bytes->data() + 12, 4);
  const char* text = reinterpret_cast<const char*>(bytes->data()) + 20;
  return {json::parse(text, text + length), {bytes->begin() + 28 + length, bytes->end()}};
}

ReadMesh readDraco(const GlbContent& glb) {
  const json& coded = glb.primitive()["extensions"]["KHR_draco_mesh_compression"];
  const auto bytes = glb.view(glb.document["bufferViews"][coded["bufferView"].get<size_t>()]);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto mesh = std::move(draco::Decoder().DecodeMeshFromBuffer(&buffer)).value();
  ReadMesh read;
  const auto get = [&](const char* name, size_t size, std::vector<float>& values) {
    if (!coded["attributes"].contains(name)) return;
    const auto* attribute = mesh->GetAttributeByUniqueId(coded["attributes"][name]);
    ASSERT_NE(attribute, nullptr) << name;
    values.resize(size * mesh->num_points());
    for (draco::PointIndex i(0); i < mesh->num_points(); ++i)
      attribute->GetMappedValue(i, &values[size * i.value()]);
  };
  get("POSITION", 3, read.positions);
  get("NORMAL", 3, read.normals);
  get("TEXCOORD_0", 2, read.texcoords);
  for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f)
    for (const draco::PointIndex& corner : mesh->face(f)) read.triangles.push_back(corner.value());
  return read;
}

/// What a loader makes of the view below an accessor: bytes after the filter.
std::vector<std::byte> meshoptBytes(const GlbContent& glb, size_t accessor, size_t& stride) {
  const json& view =
      glb.document["bufferViews"][glb.document["accessors"][accessor]["bufferView"].get<size_t>()];
  const json& coded = view["extensions"]["EXT_meshopt_compression"];
  const auto bytes = glb.view(coded);
  const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
  const size_t count = coded["count"];
  stride = coded["byteStride"];
  EXPECT_EQ(view["byteLength"], count * stride);
  std::vector<std::byte> items(count * stride);
  const bool indices = coded["mode"] == "TRIANGLES";
  EXPECT_EQ(indices ? meshopt_decodeIndexBuffer(items.data(), count, stride, data, bytes.size())
                    : meshopt_decodeVertexBuffer(items.data(), count, stride, data, bytes.size()),
            0);
  const std::string filter = coded.value("filter", "NONE");
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(items.data(), count, stride);
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(items.data(), count, stride);
  return items;
}

/// `size` numbers of T an item, times `unit`.
template <class T>
std::vector<float> numbers(const GlbContent& glb, size_t accessor, size_t size, float unit) {
  size_t stride = 0;
  const auto items = meshoptBytes(glb, accessor, stride);
  std::vector<float> values;
  for (size_t at = 0; at < items.size(); at += stride) {
    for (size_t k = 0; k < size; ++k) {
      T value;
      std::memcpy(&value, &items[at + k * sizeof(T)], sizeof(T));
      values.push_back(static_cast<float>(value) * unit);
    }
  }
  return values;
}

ReadMesh readMeshopt(const GlbContent& glb) {
  const json& attributes = glb.primitive()["attributes"];
  ReadMesh read;
  read.positions = numbers<float>(glb, attributes["POSITION"], 3, 1);
  read.normals = numbers<int8_t>(glb, attributes["NORMAL"], 3, 1 / 127.0F);
  if (attributes.contains("TEXCOORD_0"))
    read.texcoords = numbers<uint16_t>(glb, attributes["TEXCOORD_0"], 2, 1 / 65535.0F);
  size_t stride = 0;
  const size_t indices = glb.primitive()["indices"];
  const auto items = meshoptBytes(glb, indices, stride);
  for (size_t at = 0; at < items.size(); at += stride) {
    uint32_t index = 0;
    std::memcpy(&index, &items[at], stride);
    read.triangles.push_back(index);
  }
  return read;
}

/// A hill of side x side vertices, with normals of its own and texture coordinates.
MeshFile hillOf(uint32_t side, float height) {
  MeshFile mesh;
  const auto last = static_cast<float>(side - 1);
  for (uint32_t i = 0; i < side * side; ++i) {
    const float x = float(i % side) * 30 - 15 * last, z = float(i / side) * 30 - 15 * last;
    mesh.positions.insert(mesh.positions.end(),
                          {x, height * std::sin(x / 90) * std::cos(z / 70), z});
    mesh.texcoords.insert(mesh.texcoords.end(), {float(i % side) / last, float(i / side) / last});
    const float tilt = 0.6F * std::sin(x);
    mesh.normals.insert(mesh.normals.end(), {std::sin(tilt), std::cos(tilt), 0});
  }
  for (uint32_t row = 0; row + 1 < side; ++row) {
    for (uint32_t column = 0; column + 1 < side; ++column) {
      const uint32_t a = row * side + column, b = a + 1, c = a + side, d = c + 1;
      mesh.triangles.insert(mesh.triangles.end(), {a, c, b, b, c, d});
    }
  }
  return mesh;
}

std::array<uint32_t, 3> turned(std::array<uint32_t, 3> t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

using Triangles = std::multiset<std::array<uint32_t, 3>>;

Triangles trianglesOf(std::span<const uint32_t> corners) {
  Triangles set;
  for (size_t i = 0; i < corners.size(); i += 3)
    set.insert(turned({corners[i], corners[i + 1], corners[i + 2]}));
  return set;
}

/// Vertices of the grid below 2^32 metres are found by their place.
void expectSame(const ReadMesh& read, const MeshFile& mesh, uint32_t side) {
  const PositionSteps steps = positionSteps(meshBounds(mesh.positions));
  const double horizontal = steps.horizontal / 2 + 1e-3, vertical = steps.vertical / 2 + 1e-3;
  ASSERT_EQ(read.positions.size(), read.normals.size());
  std::vector<uint32_t> origin;
  for (size_t i = 0; i < read.positions.size() / 3; ++i) {
    const float* at = &read.positions[3 * i];
    const double middle = 15.0 * (side - 1);
    const auto column = static_cast<uint32_t>(std::lround((at[0] + middle) / 30));
    const auto row = static_cast<uint32_t>(std::lround((at[2] + middle) / 30));
    ASSERT_LT(std::max(row, column), side);
    const size_t v = size_t{row} * side + column;
    origin.push_back(static_cast<uint32_t>(v));
    EXPECT_NEAR(at[0], mesh.positions[3 * v], horizontal);
    EXPECT_NEAR(at[1], mesh.positions[3 * v + 1], vertical);
    EXPECT_NEAR(at[2], mesh.positions[3 * v + 2], horizontal);
    const float* normal = &read.normals[3 * i];
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    double product = 0;
    for (size_t k = 0; k < 3; ++k) product += double{normal[k]} * mesh.normals[3 * v + k];
    EXPECT_NEAR(length, 1, 0.01);
    EXPECT_GT(product / length, std::cos(0.02)) << i;
    for (size_t k = 0; k < 2 && !mesh.texcoords.empty(); ++k)
      EXPECT_NEAR(read.texcoords[2 * i + k], mesh.texcoords[2 * v + k], 1e-5);
  }
  EXPECT_EQ(read.texcoords.empty(), mesh.texcoords.empty());
  std::vector<uint32_t> corners;
  for (const uint32_t corner : read.triangles) corners.push_back(origin.at(corner));
  EXPECT_EQ(trianglesOf(corners), trianglesOf(mesh.triangles));
}

class CompressedMeshes : public ScratchFolder,
                         public ::testing::WithParamInterface<MeshCompression> {
 protected:
  ReadMesh roundTrip(const MeshFile& mesh) {
    const Status written = writeMesh(path("a.glb"), mesh, "", {GetParam(), {}});
    EXPECT_TRUE(written.ok()) << written.message();
    const GlbContent glb = readGlb(path("a.glb"));
    const bool draco = GetParam() == MeshCompression::kDraco;
    ReadMesh read = draco ? readDraco(glb) : readMeshopt(glb);
    expectStated(glb, read);
    return read;
  }

 private:
  /// Counts and bounds of the accessors are those of what is decoded.
  void expectStated(const GlbContent& glb, const ReadMesh& read) {
    const json& accessors = glb.document["accessors"];
    const size_t position = glb.primitive()["attributes"]["POSITION"];
    const size_t indices = glb.primitive()["indices"];
    EXPECT_EQ(accessors[position]["count"], read.positions.size() / 3);
    EXPECT_EQ(accessors[indices]["count"], read.triangles.size());
    EXPECT_EQ(accessors[indices]["componentType"],
              read.positions.size() / 3 <= 65535 ? 5123 : 5125);
    const MeshBounds bounds = meshBounds(read.positions);
    EXPECT_EQ(accessors[position]["min"].get<decltype(bounds.low)>(), bounds.low);
    EXPECT_EQ(accessors[position]["max"].get<decltype(bounds.high)>(), bounds.high);
  }
};
INSTANTIATE_TEST_SUITE_P(All, CompressedMeshes,
                         ::testing::Values(MeshCompression::kDraco, MeshCompression::kMeshopt),
                         [](const auto& parameter) {
                           const bool draco = parameter.param == MeshCompression::kDraco;
                           return std::string(draco ? "Draco" : "Meshopt");
                         });

TEST_P(CompressedMeshes, ComeBackWithinTheQuantisation) {
  for (const uint32_t side : {2U, 3U, 40U, 300U}) {
    for (const float height : {0.0F, 0.01F, 700.0F}) {
      for (const bool textured : {false, true}) {
        SCOPED_TRACE(std::to_string(side) + " " + std::to_string(height));
        MeshFile mesh = hillOf(side, height);
        if (!textured) mesh.texcoords.clear();
        expectSame(roundTrip(mesh), mesh, side);
        if (HasFailure()) return;
      }
    }
  }
}

TEST_P(CompressedMeshes, HighGroundKeepsItsSmallRelief) {
  MeshFile mesh = hillOf(9, 3);
  for (size_t i = 1; i < mesh.positions.size(); i += 3) mesh.positions[i] += 8000;
  expectSame(roundTrip(mesh), mesh, 9);
}

TEST_P(CompressedMeshes, AreSmaller) {
  const MeshFile mesh = hillOf(60, 700);
  roundTrip(mesh);
  const auto coded = std::filesystem::file_size(path("a.glb"));
  ASSERT_TRUE(writeMesh(path("b.glb"), mesh).ok());
  EXPECT_LT(coded, std::filesystem::file_size(path("b.glb")) / 3);
}

class MeshFileOptions : public ScratchFolder {};

/// Its coder would count each of the steps between the heights.
TEST_F(MeshFileOptions, DracoTakesNoAbsurdHeights) {
  const MeshOptions draco{MeshCompression::kDraco, {}};
  EXPECT_TRUE(writeMesh(path("a.glb"), hillOf(9, 1e3F), "", draco).ok());
  EXPECT_EQ(writeMesh(path("b.glb"), hillOf(9, 1e12F), "", draco).code(), TKS_LIMIT);
  EXPECT_FALSE(std::filesystem::exists(path("b.glb")));
}

/// It counts the steps of a unit in floats, and would read beyond its tables.
TEST_F(MeshFileOptions, DracoTakesNoAbsurdSizes) {
  const MeshOptions draco{MeshCompression::kDraco, {}};
  for (const float size : {1e-42F, 1e-38F, 2.5e36F}) {
    MeshFile mesh = hillOf(9, 3);
    for (float& at : mesh.positions) at *= size;
    EXPECT_EQ(writeMesh(path("a.glb"), mesh, "", draco).code(), TKS_LIMIT) << size;
  }
}

TEST_F(MeshFileOptions, MeshOptionsAreForGlb) {
  const MeshOptions draco{MeshCompression::kDraco, {}};
  for (const char* name : {"a.ply", "a.obj"})
    EXPECT_EQ(checkMeshOptions(name, draco).code(), TKS_USAGE);
  EXPECT_TRUE(checkMeshOptions("a.glb", draco).ok());
  EXPECT_TRUE(checkMeshOptions("a.ply", {}).ok());
}

TEST_F(MeshFileOptions, GlbTexturesTakeTheFormatAskedFor) {
  for (uint32_t channels = 1; channels <= 4; ++channels) {
    for (const tks_sample sample : {TKS_U8, TKS_U16}) {
      ImageFile texture{16, 8, channels, sample, {}};
      texture.data.resize(16 * 8 * channels * tks_sample_bytes(sample), std::byte{90});
      MeshFile mesh = hillOf(3, 10);
      mesh.texture = &texture;
      ASSERT_TRUE(writeMesh(path("a.glb"), mesh, "", {{}, MeshTexture::kWebp}).ok());
      const json webp = readGlb(path("a.glb")).document;
      EXPECT_EQ(webp["images"][0]["mimeType"], "image/webp");
      EXPECT_EQ(webp["textures"][0]["extensions"]["EXT_texture_webp"]["source"], 0);
      EXPECT_FALSE(webp["textures"][0].contains("source"));
      ASSERT_TRUE(writeMesh(path("a.glb"), mesh, "", {{}, MeshTexture::kPng}).ok());
      EXPECT_EQ(readGlb(path("a.glb")).document["images"][0]["mimeType"], "image/png");
      const Status jpeg = writeMesh(path("a.glb"), mesh, "", {{}, MeshTexture::kJpeg});
      EXPECT_EQ(jpeg.code(), channels % 2 == 0 ? TKS_USAGE : TKS_OK) << jpeg.message();
    }
  }
}

/// PATH with nothing in it but one program, a shell script.
class OnlyProgram {
 public:
  OnlyProgram(const std::string& folder, const char* name, const std::string& script) {
    std::filesystem::create_directory(folder);
    const std::string path = folder + "/" + name;
    std::ofstream(path) << "#!/bin/sh\n" << script << "\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    setenv("PATH", folder.c_str(), 1);
  }
  ~OnlyProgram() { setenv("PATH", before_.c_str(), 1); }

 private:
  const std::string before_ = std::getenv("PATH");
};

Status writeKtx2(const std::string& path, uint32_t channels) {
  ImageFile texture{10, 7, channels, TKS_U8, {}};
  texture.data.resize(size_t{10} * 7 * channels, std::byte{90});
  MeshFile mesh = hillOf(3, 10);
  mesh.texture = &texture;
  return writeMesh(path, mesh, "", {{}, MeshTexture::kKtx2});
}

constexpr const char* kKtx2Magic = "\\253KTX 20\\273\\r\\n\\032\\n";

/// What the program writes goes into the GLB, and what it is given are whole blocks of colours.
TEST_F(MeshFileOptions, Ktx2TexturesAreMadeByAProgram) {
  const std::string seen = path("seen.png");
  for (const char* name : {"ktx", "basisu"}) {
    for (uint32_t channels = 1; channels <= 4; ++channels) {
      const std::string find =
          "for word; do case $word in *.png) png=$word;; *.ktx2) ktx2=$word;; esac; done\n";
      const OnlyProgram program(
          path(name), name,
          find + "/bin/cat $png > " + seen + "; printf '" + kKtx2Magic + "rest' > $ktx2");
      ASSERT_TRUE(writeKtx2(path("a.glb"), channels).ok());
      const GlbContent glb = readGlb(path("a.glb"));
      EXPECT_EQ(glb.document["images"][0]["mimeType"], "image/ktx2");
      EXPECT_EQ(glb.document["textures"][0]["extensions"]["KHR_texture_basisu"]["source"], 0);
      EXPECT_EQ(glb.document["extensionsRequired"], json::array({"KHR_texture_basisu"}));
      const auto view = glb.document["images"][0]["bufferView"].get<size_t>();
      const auto bytes = glb.view(glb.document["bufferViews"][view]);
      EXPECT_EQ(std::string(reinterpret_cast<const char*>(bytes.data()) + 12, 4), "rest");
      const Result<ImageFile> given = readImage(seen);
      ASSERT_TRUE(given.ok());
      EXPECT_EQ(given->width, 12u);
      EXPECT_EQ(given->height, 8u);
      EXPECT_EQ(given->channels, channels % 2 == 0 ? 4u : 3u);
      EXPECT_EQ(given->data.front(), std::byte{90});
    }
  }
}

TEST_F(MeshFileOptions, Ktx2WithoutItsProgramIsASentence) {
  {
    const OnlyProgram other(path("other"), "other", "");
    const Status none = writeKtx2(path("a.glb"), 3);
    EXPECT_EQ(none.code(), TKS_UNSUPPORTED);
    EXPECT_NE(none.message().find("basisu"), std::string::npos) << none.message();
  }
  {
    const OnlyProgram broken(path("broken"), "basisu", "echo first; echo no good; exit 3");
    const Status status = writeKtx2(path("a.glb"), 3);
    EXPECT_EQ(status.code(), TKS_IO);
    EXPECT_NE(status.message().find("'basisu' failed: no good"), std::string::npos)
        << status.message();
  }
  {
    const OnlyProgram liar(path("liar"), "ktx", "for word; do :; done; echo x > $word");
    EXPECT_EQ(writeKtx2(path("a.glb"), 4).code(), TKS_IO);
  }
  EXPECT_FALSE(std::filesystem::exists(path("a.glb")));
}

}  // namespace
}  // namespace tetrakis::tools
