// SPDX-License-Identifier: Apache-2.0
// Meshes of other programs: the same triangles, texture coordinates and texture come back from
// every format, and what is wrong with a file is said in a sentence.
#include "apps/tools/files/meshes/surface_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <span>

#include "tests/support/scratch_folder.hpp"

namespace tetrakis::tools {
namespace {

using test::ScratchFolder;

constexpr float kTexels = 32;

/// Hills over side x side vertices, up to 33 x 33, with a texture: whole numbers and 32nds, so that
/// what files round is still known.
MeshFile hill(uint32_t side) {
  MeshFile mesh;
  for (uint32_t row = 0; row < side; ++row) {
    for (uint32_t column = 0; column < side; ++column) {
      const float x = float(column), z = float(row);
      mesh.positions.insert(mesh.positions.end(), {x, float(column * row % 7), z});
      mesh.texcoords.insert(mesh.texcoords.end(), {x / kTexels, z / kTexels});
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

ImageFile chequers(uint32_t channels) {
  ImageFile image{16, 8, channels, TKS_U8, {}};
  image.data.resize(16 * 8 * channels);
  for (size_t i = 0; i < image.data.size(); ++i) image.data[i] = std::byte((i / 8) % 2 * 200 + 20);
  return image;
}

/// A triangle by what stands at its corners, rounded, from its least corner on: Draco orders
/// triangles and their corners anew.
using Corner = std::array<long, 5>;
using Shown = std::array<Corner, 3>;

Shown shown(Shown corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::multiset<Shown> shownBy(const MeshFile& mesh) {
  std::multiset<Shown> all;
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    Shown corners{};
    for (size_t k = 0; k < 3; ++k) {
      const size_t v = mesh.triangles[i + k];
      for (size_t axis = 0; axis < 3; ++axis)
        corners[k][axis] = std::lround(mesh.positions[3 * v + axis]);
      for (size_t axis = 0; axis < 2 && !mesh.texcoords.empty(); ++axis)
        corners[k][3 + axis] = std::lround(mesh.texcoords[2 * v + axis]);
    }
    all.insert(shown(corners));
  }
  return all;
}

std::multiset<Shown> shownBy(const SurfaceFile& mesh) {
  std::multiset<Shown> all;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    Shown corners{};
    for (size_t k = 0; k < 3; ++k) {
      for (size_t axis = 0; axis < 3; ++axis)
        corners[k][axis] = std::lround(mesh.points[mesh.triangles[i][k]][axis]);
      for (size_t axis = 0; axis < 2 && !mesh.texcoords.empty(); ++axis)
        corners[k][3 + axis] = std::lround(mesh.texcoords[3 * i + k][axis]);
    }
    all.insert(shown(corners));
  }
  return all;
}

class SurfaceFiles : public ScratchFolder {
 protected:
  std::string text(const std::string& name, const std::string& content) const {
    return save(name, std::vector<char>(content.begin(), content.end()));
  }
  /// The sentence of a file that has to fail.
  std::string failureOf(const std::string& file, tks_status code) const {
    const auto read = readSurface(file);
    EXPECT_FALSE(read.ok());
    EXPECT_EQ(read.status().code(), code) << read.status().message();
    return read.status().message();
  }
  SurfaceFile read(const std::string& file, std::string* note = nullptr) const {
    auto surface = readSurface(file, note);
    EXPECT_TRUE(surface.ok()) << surface.status().message();
    return surface.ok() ? std::move(*surface) : SurfaceFile{};
  }
};

TEST_F(SurfaceFiles, ComeBackFromWhatWeWrite) {
  const ImageFile texture = chequers(4);
  for (const char* const name : {"hill.glb", "hill.obj", "hill.ply"}) {
    for (const bool textured : {false, true}) {
      SCOPED_TRACE(name);
      MeshFile mesh = hill(21);
      if (!textured) mesh.texcoords.clear();
      const bool keeps_texture = textured && name != std::string("hill.ply");
      if (keeps_texture) mesh.texture = &texture;
      ASSERT_TRUE(writeMesh(path(name), mesh).ok());
      std::string note;
      const SurfaceFile surface = read(path(name), &note);
      EXPECT_EQ(surface.points.size(), mesh.positions.size() / 3);
      EXPECT_TRUE(shownBy(surface) == shownBy(mesh));
      ASSERT_EQ(surface.texture.has_value(), keeps_texture);
      EXPECT_TRUE(!keeps_texture || surface.texture->data == texture.data);
      EXPECT_EQ(surface.y_is_up, name == std::string("hill.glb"));
      EXPECT_EQ(note, "");
      std::filesystem::remove(path("hill.png"));
    }
  }
}

TEST_F(SurfaceFiles, ComeBackFromDraco) {
  const MeshFile mesh = hill(33);
  ASSERT_TRUE(writeMesh(path("a.glb"), mesh, "", {MeshCompression::kDraco, {}}).ok());
  const SurfaceFile surface = read(path("a.glb"));
  EXPECT_EQ(surface.points.size(), mesh.positions.size() / 3);
  EXPECT_TRUE(shownBy(surface) == shownBy(mesh));
}

TEST_F(SurfaceFiles, WhatMeshoptHasCompressedIsRefused) {
  ASSERT_TRUE(writeMesh(path("a.glb"), hill(9), "", {MeshCompression::kMeshopt, {}}).ok());
  const std::string why = failureOf(path("a.glb"), TKS_USAGE);
  EXPECT_NE(why.find("EXT_meshopt_compression"), why.npos) << why;
}

TEST_F(SurfaceFiles, JpegInsideAGlbIsTheTexture) {
  const ImageFile texture = chequers(3);
  MeshFile mesh = hill(3);
  mesh.texture = &texture;
  ASSERT_TRUE(writeMesh(path("a.glb"), mesh).ok());
  const SurfaceFile surface = read(path("a.glb"));
  ASSERT_TRUE(surface.texture.has_value());
  EXPECT_EQ(surface.texture->width, 16U);
  EXPECT_EQ(surface.texture->channels, 3U);
  EXPECT_EQ(surface.base_colour, (std::array<double, 4>{1, 1, 1, 1}));
}

const std::string kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

TEST_F(SurfaceFiles, ObjCornersHaveTextureCoordinatesOfTheirOwn) {
  const std::string seam =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 0.5 0.25\n"
      "f 1/1 2/2 3/3\nf 3/4 2/1 4/3\n";
  const SurfaceFile surface = read(text("a.obj", seam));
  EXPECT_EQ(surface.points.size(), 4U);
  const std::vector<std::array<uint32_t, 3>> triangles{{0, 1, 2}, {2, 1, 3}};
  EXPECT_EQ(surface.triangles, triangles);
  const std::vector<std::array<float, 2>> corners{{0, 1},        {1, 1}, {0, 0},
                                                  {0.5F, 0.75F}, {0, 1}, {0, 0}};
  EXPECT_EQ(surface.texcoords, corners);
  EXPECT_EQ(surface.name, "a");
}

TEST_F(SurfaceFiles, StlHasItsPointsOnce) {
  std::string ascii = "solid tip\n";
  const std::array<const char*, 4> points{"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
  const std::array<std::array<size_t, 3>, 4> faces{{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  for (const auto& face : faces) {
    ascii += "facet normal 0 0 0\nouter loop\n";
    for (const size_t corner : face) ascii += std::string("vertex ") + points[corner] + "\n";
    ascii += "endloop\nendfacet\n";
  }
  const SurfaceFile surface = read(text("a.stl", ascii + "endsolid tip\n"));
  EXPECT_EQ(surface.points.size(), 4U);
  EXPECT_EQ(surface.triangles.size(), 4U);
  const SurfaceFile same = read(text("b.obj", kTetrahedron));
  EXPECT_EQ(shownBy(surface), shownBy(same));
}

TEST_F(SurfaceFiles, PolygonsAreCutAndLinesDropped) {
  std::string note;
  const SurfaceFile surface =
      read(text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 5\nf 1 2 3 4\nl 1 5\n"), &note);
  EXPECT_EQ(surface.triangles.size(), 2U);
  EXPECT_EQ(surface.points.size(), 4U);
  EXPECT_EQ(note, "1 polygon is cut into triangles, 1 point or line is left out");
}

using Colour = std::array<int, 3>;

ImageFile plain(uint32_t width, uint32_t height, const Colour& colour) {
  ImageFile image{width, height, 3, TKS_U8, {}};
  for (size_t i = 0; i < size_t{width} * height; ++i)
    for (const int value : colour) image.data.push_back(std::byte(value));
  return image;
}

/// What the surface shows between the corners of a triangle, whose weights these are.
Colour shownAt(const SurfaceFile& surface, size_t triangle, const std::array<double, 3>& weights) {
  const ImageFile& image = *surface.texture;
  double x = -0.5, y = -0.5;
  for (size_t k = 0; k < 3; ++k) {
    x += weights[k] * double(surface.texcoords[3 * triangle + k][0]) * image.width;
    y += weights[k] * double(surface.texcoords[3 * triangle + k][1]) * image.height;
  }
  const auto at = [&](double column, double row, size_t channel) {
    const double c = std::clamp(column, 0.0, image.width - 1.0),
                 r = std::clamp(row, 0.0, image.height - 1.0);
    return double(image.data[(size_t(r) * image.width + size_t(c)) * 3 + channel]);
  };
  Colour colour{};
  const double left = std::floor(x), top = std::floor(y), u = x - left, v = y - top;
  for (size_t channel = 0; channel < 3; ++channel) {
    const double upper = (1 - u) * at(left, top, channel) + u * at(left + 1, top, channel);
    const double lower = (1 - u) * at(left, top + 1, channel) + u * at(left + 1, top + 1, channel);
    colour[channel] = int(std::lround((1 - v) * upper + v * lower));
  }
  return colour;
}

constexpr std::array<std::array<double, 3>, 5> kWithin{
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0}, {0.4, 0.3, 0.3}}};

TEST_F(SurfaceFiles, TexturesAndColoursOfPartsBecomeOneTexture) {
  ASSERT_TRUE(writeImage(path("red.png"), plain(16, 8, {200, 10, 20})).ok());
  ASSERT_TRUE(writeImage(path("blue.png"), plain(3, 40, {10, 20, 250})).ok());
  text("a.mtl",
       "newmtl one\nKd 1 0.5 1\nmap_Kd red.png\nnewmtl two\nmap_Kd blue.png\n"
       "newmtl three\nKd 0 1 0\nnewmtl four\nKd 0 1 0\nmap_Kd gone.png\n");
  std::string note;
  const SurfaceFile surface =
      read(text("a.obj",
                "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
                "usemtl two\nf 1/1 3/2 2/3\nusemtl one\nf 1/1 2/2 4/3\nusemtl three\n"
                "f 2/1 3/2 4/3\nusemtl four\nf 4/1 3/2 1/3\n"),
           &note);
  ASSERT_TRUE(surface.texture.has_value());
  const std::array<Colour, 4> colours{{{10, 20, 250}, {200, 5, 20}, {0, 255, 0}, {0, 255, 0}}};
  for (size_t triangle = 0; triangle < 4; ++triangle)
    for (const auto& weights : kWithin)
      EXPECT_EQ(shownAt(surface, triangle, weights), colours[triangle]) << triangle;
  EXPECT_EQ(surface.base_colour, (std::array<double, 4>{1, 1, 1, 1}));
  EXPECT_EQ(note, "4 parts are joined, 3 textures become one, its texture 'gone.png' is not there");
}

TEST_F(SurfaceFiles, TexturesThatRepeatStandInTheirPageAsOften) {
  ImageFile ramp = plain(64, 4, {0, 0, 0});
  for (size_t i = 0; i < ramp.data.size(); ++i) ramp.data[i] = std::byte(i / 3 % 64 * 3);
  ASSERT_TRUE(writeImage(path("ramp.png"), ramp).ok());
  text("r.mtl", "newmtl one\nmap_Kd ramp.png\nnewmtl two\nKd 0 1 0\n");
  const SurfaceFile surface = read(text(
      "r.obj",
      "mtllib r.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt -7.75 0.5\nvt -5.25 0.5\n"
      "vt -6.25 3.5\nvt 1e30 0\nusemtl one\nf 1/1 2/2 3/3\nf 1/4 2/4 3/4\nusemtl two\nf 3 2 1\n"));
  ASSERT_TRUE(surface.texture.has_value());
  EXPECT_NEAR(shownAt(surface, 0, {1, 0, 0})[0], 3 * (64 * 0.25 - 0.5), 1);
  EXPECT_NEAR(shownAt(surface, 0, {0, 1, 0})[1], 3 * (64 * 0.75 - 0.5), 1);
  EXPECT_NEAR(shownAt(surface, 0, {0.5, 0.5, 0})[2], 3 * (64 * 0.5 - 0.5), 1);
  EXPECT_EQ(shownAt(surface, 2, {0.3, 0.3, 0.4}), (Colour{0, 255, 0}));
  for (const auto& [u, v] : surface.texcoords)
    EXPECT_TRUE(u >= 0 && u <= 1 && v >= 0 && v <= 1) << u << ' ' << v;
}

TEST_F(SurfaceFiles, WideAndTallTexturesTakeNoImageOfBothSides) {
  ASSERT_TRUE(writeImage(path("wide.png"), plain(30000, 1, {200, 10, 20})).ok());
  ASSERT_TRUE(writeImage(path("tall.png"), plain(1, 30000, {10, 20, 250})).ok());
  text("w.mtl", "newmtl one\nmap_Kd wide.png\nnewmtl two\nKd 0 1 0\nmap_Kd tall.png\n");
  std::string note;
  const SurfaceFile surface =
      read(text("w.obj",
                "mtllib w.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                "usemtl one\nf 1/1 2/2 3/3\nusemtl two\nf 3/3 2/2 1/1\n"),
           &note);
  ASSERT_TRUE(surface.texture.has_value());
  EXPECT_LT(uint64_t{surface.texture->width} * surface.texture->height, uint64_t{1} << 27);
  EXPECT_NE(note.find("30000 x 1 is left out"), std::string::npos) << note;
  EXPECT_EQ(shownAt(surface, 1, kWithin[4]), (Colour{0, 20, 0}));
}

TEST_F(SurfaceFiles, ColoursAtCornersBecomeATexture) {
  std::string note;
  const SurfaceFile surface =
      read(text("c.ply",
                "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
                "0 0 0 100 50 60\n1 0 0 150 80 40\n0 1 0 90 100 60\n0 0 1 130 140 150\n"
                "3 0 1 2\n3 0 1 3\n3 2 1 3\n"),
           &note);
  ASSERT_TRUE(surface.texture.has_value());
  EXPECT_TRUE(surface.has_corner_colours);
  const std::array<Colour, 4> colours{
      {{100, 50, 60}, {150, 80, 40}, {90, 100, 60}, {130, 140, 150}}};
  for (size_t triangle = 0; triangle < surface.triangles.size(); ++triangle) {
    for (const auto& weights : kWithin) {
      const Colour shown = shownAt(surface, triangle, weights);
      for (size_t channel = 0; channel < 3; ++channel) {
        double expected = 0;
        for (size_t k = 0; k < 3; ++k)
          expected += weights[k] * colours[surface.triangles[triangle][k]][channel];
        EXPECT_NEAR(shown[channel], expected, 1) << triangle;
      }
    }
  }
  EXPECT_EQ(note, "colours at corners become a texture");
}

TEST_F(SurfaceFiles, PartsAreJoined) {
  ASSERT_TRUE(writeImage(path("most.png"), chequers(3)).ok());
  text("a.mtl", "newmtl one\nKd 1 0.5 0.25\nmap_Kd C:\\old\\most.png\n");
  std::string note;
  const SurfaceFile surface =
      read(text("a.obj",
                "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
                "usemtl one\nf 1/1 3/2 2/3\no b\nusemtl one\nf 1/1 2/2 4/3\nf 2/1 3/2 4/3\n"),
           &note);
  EXPECT_EQ(surface.points.size(), 4U);
  EXPECT_EQ(surface.triangles.size(), 3U);
  ASSERT_TRUE(surface.texture.has_value());
  EXPECT_TRUE(surface.texture->data == chequers(3).data);
  EXPECT_EQ(surface.base_colour, (std::array<double, 4>{1, 0.5, 0.25, 1}));
  EXPECT_EQ(note, "2 parts are joined");
}

TEST_F(SurfaceFiles, AMissingTextureIsANote) {
  text("a.mtl", "newmtl one\nmap_Kd lost.png\n");
  std::string note;
  const SurfaceFile surface =
      read(text("a.obj",
                "mtllib a.mtl\nusemtl one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                "f 1/1 2/2 3/3\n"),
           &note);
  EXPECT_FALSE(surface.texture.has_value());
  EXPECT_EQ(surface.texcoords.size(), 3U);
  EXPECT_EQ(note, "its texture 'lost.png' is not there");
}

TEST_F(SurfaceFiles, APictureOfTheSameNameIsTheTexture) {
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
  ASSERT_TRUE(writeImage(path("a.png"), chequers(1)).ok());
  std::string note;
  const SurfaceFile surface = read(text("a.obj", mesh), &note);
  ASSERT_TRUE(surface.texture.has_value());
  EXPECT_EQ(surface.texture->channels, 3U);
  EXPECT_EQ(surface.base_colour, (std::array<double, 4>{1, 1, 1, 1}));
  EXPECT_NE(note.find("a.png' is taken as its texture"), note.npos) << note;
  EXPECT_FALSE(read(text("b.obj", mesh)).texture.has_value());
}

/// A glTF of one triangle with two nodes: one moves it, one mirrors it.
std::string gltfOf(const std::string& base64) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)"
         R"({"children":[1,2],"scale":[2,2,2]},{"mesh":0,"translation":[0,0,3]},)"
         R"({"mesh":0,"scale":[-1,1,1]}],"meshes":[{"primitives":[{"attributes":)"
         R"({"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,)"
         R"("type":"VEC3","min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,)"
         R"("byteLength":36}],"buffers":[{"byteLength":36,"uri":)"
         R"("data:application/octet-stream;base64,)" +
         base64 + R"("}]})";
}

TEST_F(SurfaceFiles, NodesPlaceTheirMeshesAndMirrorsKeepTheOutside) {
  // (0, 0, 0), (1, 0, 0), (0, 1, 0)
  const std::string points = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  const SurfaceFile surface = read(text("a.gltf", gltfOf(points)));
  const std::vector<std::array<double, 3>> expected{{0, 0, 6}, {2, 0, 6}, {0, 2, 6},
                                                    {0, 0, 0}, {0, 2, 0}, {-2, 0, 0}};
  EXPECT_EQ(surface.points, expected);
  const std::vector<std::array<uint32_t, 3>> triangles{{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(surface.triangles, triangles);
  EXPECT_TRUE(surface.y_is_up);
}

TEST_F(SurfaceFiles, FailuresAreSentences) {
  EXPECT_NE(failureOf(path("none.obj"), TKS_IO).find("none.obj"), std::string::npos);
  EXPECT_EQ(isMeshFile(text("a.txt", kTetrahedron)), false);
  failureOf(path("a.txt"), TKS_USAGE);
  failureOf(text("empty.obj", ""), TKS_USAGE);
  const std::string points =
      failureOf(text("points.ply",
                     "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                     "property float y\nproperty float z\nend_header\n0 0 0\n"),
                TKS_USAGE);
  EXPECT_NE(points.find("no triangles"), points.npos) << points;
  const std::string nan =
      failureOf(text("nan.ply",
                     "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                     "property float y\nproperty float z\nelement face 2\n"
                     "property list uchar int vertex_indices\nend_header\n"
                     "0 0 0\n1 0 0\n0 1 0\nnan 0 0\n3 0 1 2\n3 0 2 3\n"),
                TKS_USAGE);
  EXPECT_NE(nan.find("triangle 2"), nan.npos) << nan;
}

TEST_F(SurfaceFiles, HugeClaimsEndInASentence) {
  const std::string claim =
      "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty float x\n"
      "property float y\nproperty float z\nelement face 2000000000\n"
      "property list uchar int vertex_indices\nend_header\nabcdefghijklmnop";
  EXPECT_NE(failureOf(text("a.ply", claim), TKS_USAGE).find("cut short"), std::string::npos);
}

/// Every file that is cut or has a byte changed gives a mesh or a sentence.
TEST_F(SurfaceFiles, DamageEndsInASentence) {
  const ImageFile texture = chequers(3);
  MeshFile mesh = hill(4);
  mesh.texture = &texture;
  ASSERT_TRUE(writeMesh(path("whole.glb"), mesh).ok());
  ASSERT_TRUE(writeMesh(path("whole.ply"), hill(4)).ok());
  for (const std::string extension : {".glb", ".ply"}) {
    std::ifstream file(path("whole" + extension), std::ios::binary);
    const std::vector<char> whole(std::istreambuf_iterator<char>(file), {});
    for (size_t i = 0; i < 12; ++i) {
      std::vector<char> damaged = whole;
      damaged[i * 7919 % std::min<size_t>(whole.size(), 600)] ^= static_cast<char>(1 << i % 8);
      if (i % 3 == 0) damaged.resize(whole.size() * (i + 12) / 24);
      const auto surface = readSurface(save("damaged" + extension, damaged));
      EXPECT_TRUE(surface.ok() || surface.status().message().size() > 10);
    }
  }
}

TEST_F(SurfaceFiles, AreKnownByTheirNamesOrFirstBytes) {
  for (const char* const name : {"a.glb", "a.GLTF", "a.obj", "a.PLY", "a.stl"})
    EXPECT_TRUE(isMeshFile(name)) << name;
  for (const char* const name : {"a.tif", "a.png", "a.fbx", "-", "a"})
    EXPECT_FALSE(isMeshFile(name)) << name;
  ASSERT_TRUE(writeMesh(path("scan"), hill(3), "glb").ok());
  EXPECT_TRUE(isMeshFile(path("scan")));
  EXPECT_EQ(read(path("scan")).triangles.size(), 8U);
}

}  // namespace
}  // namespace tetrakis::tools
