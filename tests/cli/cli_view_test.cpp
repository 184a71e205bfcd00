// SPDX-License-Identifier: Apache-2.0
// decode --mesh --cameras/--view: the part of a mesh that a camera sees, and the same picture of
// it.
#include <algorithm>
#include <cstdlib>
#include <map>

#include "apps/tools/files/stream.hpp"
#include "apps/tools/report/viewed_mesh.hpp"
#include "tests/cli/cli_fixture.hpp"

namespace tetrakis::test {
namespace {

class CliView : public CliTest {
 protected:
  void writeCameras(const std::string& list) { write("c.json", "{\"cameras\": [" + list + "]}"); }
  static std::string camera(const std::string& eye, const std::string& target) {
    return "{\"eye\": [" + eye + "], \"target\": [" + target + "], \"fov_y\": 20}";
  }
  size_t decodedBytes(const std::string& arguments) {
    const Outcome run = cli("decode a.tks --mesh - " + arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_TRUE(run.out.starts_with("glTF"));
    return run.out.size();
  }
};

TEST_F(CliView, AMeshIsCutToWhatTheCameraSees) {
  makeStream(65);
  writeCameras(camera("300, 3000, 900", "300, 0, 0"));
  const size_t whole = decodedBytes("");
  EXPECT_EQ(decodedBytes("--view oblique"), whole);
  EXPECT_LT(decodedBytes("--cameras c.json"), whole);
}

TEST_F(CliView, OneCameraThatSeesGroundIsNeeded) {
  makeStream(65);
  const std::string down = camera("0, 3000, 900", "0, 0, 0");
  const std::string up = camera("0, 30000, 0", "0, 90000, 1");
  writeCameras(down + ", " + down);
  EXPECT_EQ(cli("decode a.tks --mesh m.ply --cameras c.json").code, 1);
  writeCameras(up);
  EXPECT_EQ(cli("decode a.tks --mesh m.ply --cameras c.json").code, 1);
  for (const char* wrong :
       {"--mesh m.ply --view all", "--mesh m.ply --view inside", "--height h.tif --view top",
        "--mesh m.ply --view top --cameras c.json"})
    EXPECT_EQ(cli("decode a.tks " + std::string(wrong)).code, 1) << wrong;
  EXPECT_EQ(cli("decode a.tks --mesh m.ply --cameras none.json").code, 2);
}

TEST_F(CliView, MeshesOfFewTrianglesAreMadeForAllCameras) {
  makeStream(65);
  const std::string near = camera("300, 3000, 900", "300, 0, 0");
  writeCameras(near + ", " + camera("-300, 3000, 900", "0, 0, 0"));
  const auto decoded = [&](const std::string& arguments) {
    const Outcome run = cli("decode a.tks --triangles 300 --mesh - " + arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    return run.out;
  };
  const std::string map = decoded(""), turned = decoded("--turn-edges");
  EXPECT_NE(turned, map);
  for (const char* cameras : {"--cameras c.json", "--view low", "--view all", "--view any"}) {
    EXPECT_NE(decoded(cameras), map) << cameras;
    EXPECT_NE(decoded(cameras), turned) << cameras;
    EXPECT_EQ(decoded(cameras), decoded(cameras + std::string(" --turn-edges"))) << cameras;
  }
  writeCameras(near + ", {\"name\": \"sky\", \"eye\": [0, 30000, 0], \"target\": [0, 90000, 1]}");
  const Outcome blind = cli("decode a.tks --triangles 300 --mesh m.ply --cameras c.json");
  EXPECT_EQ(blind.code, 1);
  EXPECT_NE(blind.err.find("'sky'"), std::string::npos) << blind.err;
  EXPECT_EQ(cli("decode a.tks --turn-edges --mesh m.ply").code, 1);
}

TEST_F(CliView, TheCameraSeesTheSamePictureOfThePart) {
  const auto renderer = tools::Renderer::create();
  if (!renderer.ok()) GTEST_SKIP() << renderer.status().message();
  makeStream(65);
  auto stream = tools::openStream({path("a.tks"), {}, false});
  ASSERT_TRUE(stream.ok());
  const auto texture = tools::decodeImage(stream->decoder);
  ASSERT_TRUE(texture.ok());
  const GroundFrame frame = tools::frameOf(stream->decoder.info());
  const auto whole = stream->decoder.budgetMesh(0);
  ASSERT_TRUE(whole);
  std::map<uint32_t, uint32_t> vertices;  // of the whole mesh, by sample
  for (uint32_t v = 0; v < whole->vertexCount(); ++v) vertices[whole->gridIndices()[v]] = v;
  // All vertices, so that the range of depths is the same, and the triangles of `mesh`.
  const auto picture = [&](const Mesh& mesh, const Camera& camera) {
    tools::MeshFile file = tools::placeMesh(*whole, frame);
    file.texture = &*texture;
    file.triangles.clear();
    for (const uint32_t v : mesh.triangles())
      file.triangles.push_back(vertices.at(mesh.gridIndices()[v]));
    return std::move(*(*renderer)->draw(file, camera)).rgba;
  };
  for (const char* eye : {"300, 3000, 900", "-700, 500, 1200", "100, 900, 100", "0, 400, 2000"}) {
    writeCameras(camera(eye, "200, 0, -100"));
    const auto cameras = tools::readCameras(path("c.json"));
    ASSERT_TRUE(cameras.ok());
    const auto part = tools::viewedMesh(stream->decoder, false, {path("c.json"), ""});
    ASSERT_TRUE(part.ok()) << part.status().message();
    EXPECT_LT(part->triangleCount(), whole->triangleCount());
    const auto expected = picture(*whole, cameras->front());
    size_t covered = 0;
    for (size_t i = 3; i < expected.size(); i += 4) covered += expected[i] != 0;
    EXPECT_GT(covered, expected.size() / 4 / 20) << eye;
    const auto seen = picture(*part, cameras->front());
    int worst = 0;  // pixels are rounded after an interpolation that starts at any corner
    for (size_t i = 0; i < seen.size(); ++i)
      worst = std::max(worst, std::abs(seen[i] - expected[i]));
    EXPECT_LE(worst, 2) << eye;
  }
}

}  // namespace
}  // namespace tetrakis::test
