// SPDX-License-Identifier: Apache-2.0
// Mesh trees through the C interface: the mesh of tks_decode_mesh, whole and in parts.
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "tests/support/stream_fixture.hpp"

namespace tetrakis::test {
namespace {

constexpr uint32_t kGridWidth = 70, kGridHeight = 45;
using Clip = std::array<double, 16>;
/// Grid samples and heights of a triangle's corners, the smallest sample first.
using Triangle = std::array<std::pair<uint32_t, float>, 3>;

/// A map window: the columns x0 ... x1 and the rows y0 ... y1, at any height.
Clip window(double x0, double y0, double x1, double y1) {
  const double sx = 2 / (x1 - x0), sy = 2 / (y1 - y0);
  return {sx, 0, 0, -1 - sx * x0, 0, sy, 0, -1 - sy * y0, 0, 0, 0, 0, 0, 0, 0, 1};
}

struct MeshOwner {
  tks_mesh mesh = {};
  MeshOwner() = default;
  MeshOwner(const MeshOwner&) = delete;
  MeshOwner& operator=(const MeshOwner&) = delete;
  ~MeshOwner() { tks_free_mesh(&mesh); }

  std::set<Triangle> triangles() const {
    std::set<Triangle> result;
    for (size_t t = 0; t < size_t{3} * mesh.triangle_count; t += 3) {
      Triangle corners;
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t vertex = mesh.triangles[t + k];
        EXPECT_LT(vertex, mesh.vertex_count);
        corners[k] = {mesh.grid_index[vertex], mesh.height[vertex]};
      }
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      result.insert(corners);
    }
    EXPECT_EQ(result.size(), mesh.triangle_count);
    return result;
  }
};

class MeshTrees : public testing::Test {
 protected:
  const Bytes bytes_ = [] {
    const samples::Raster surface =
        samples::make({samples::Pattern::kRidges, kGridWidth, kGridHeight, 1, TKS_I16});
    return encode(&surface, nullptr, lossless());
  }();
  tks_mesh_tree* tree_ = nullptr;

  void TearDown() override { tks_free_mesh_tree(tree_); }

  void makeTree(tks_mesh_kind kind, uint32_t triangles, MeshOwner* mesh = nullptr) {
    tks_free_mesh_tree(tree_);
    Stream stream(bytes_);
    ASSERT_EQ(tks_decode_mesh_tree(stream.get(), kind, triangles, &tree_), TKS_OK);
    if (mesh) {
      ASSERT_EQ(tks_decode_mesh(stream.get(), kind, triangles, &mesh->mesh), TKS_OK);
    }
  }
};

TEST_F(MeshTrees, HoldTheMeshesOfTheDecoder) {
  for (const auto& [kind, triangles] : {std::pair(TKS_MESH_BUDGET, 0u),
                                        {TKS_MESH_BUDGET, 1u},
                                        {TKS_MESH_BUDGET, 700u},
                                        {TKS_MESH_CODED, 0u}}) {
    MeshOwner mesh, all;
    makeTree(kind, triangles, &mesh);
    ASSERT_EQ(tks_view_mesh(tree_, window(-5, -5, 100, 100).data(), &all.mesh), TKS_OK);
    EXPECT_EQ(all.triangles(), mesh.triangles());
    EXPECT_EQ(all.mesh.vertex_count, mesh.mesh.vertex_count);
  }
}

TEST_F(MeshTrees, TilesOfTheMapCoverTheMeshAndMeetWithoutCracks) {
  MeshOwner whole;
  makeTree(TKS_MESH_BUDGET, 900, &whole);
  const std::set<Triangle> expected = whole.triangles();
  std::set<Triangle> joined;
  for (double x = 0; x < kGridWidth - 1; x += 11.5)
    for (double y = 0; y < kGridHeight - 1; y += 11) {
      MeshOwner part;
      ASSERT_EQ(tks_view_mesh(tree_, window(x, y, x + 11.5, y + 11).data(), &part.mesh), TKS_OK);
      EXPECT_LT(part.mesh.triangle_count, whole.mesh.triangle_count / 3);
      joined.merge(part.triangles());
    }
  EXPECT_EQ(joined, expected);
}

TEST_F(MeshTrees, VoidsAreLeftOutAsInTheMeshesOfTheDecoder) {
  samples::Raster coast =
      samples::make({samples::Pattern::kRidges, kGridWidth, kGridHeight, 1, TKS_I16});
  constexpr int16_t kVoid = -32768;
  for (uint32_t y = 0; y < kGridHeight; ++y)
    for (uint32_t x = 0; x < kGridWidth; ++x)
      if (x + 2 * y > 90)
        std::memcpy(coast.data.data() + 2 * (y * kGridWidth + x), &kVoid, sizeof kVoid);
  tks_heights heights = coast.heights();
  heights.has_nodata = 1;
  heights.nodata = kVoid;
  const Bytes bytes = encodeHeights(heights, lossless());
  Stream stream(bytes);
  MeshOwner mesh, all, sea;
  ASSERT_EQ(tks_decode_mesh_tree(stream.get(), TKS_MESH_BUDGET, 700, &tree_), TKS_OK);
  ASSERT_EQ(tks_decode_mesh(stream.get(), TKS_MESH_BUDGET, 700, &mesh.mesh), TKS_OK);
  ASSERT_EQ(tks_view_mesh(tree_, window(0, 0, kGridWidth, kGridHeight).data(), &all.mesh), TKS_OK);
  EXPECT_EQ(all.triangles(), mesh.triangles());
  EXPECT_GT(all.mesh.triangle_count, 100u);
  ASSERT_EQ(tks_view_mesh(tree_, window(62, 37, 69, 44).data(), &sea.mesh), TKS_OK);
  EXPECT_EQ(sea.mesh.triangle_count, 0u);
}

TEST_F(MeshTrees, NothingInViewIsAnEmptyMesh) {
  makeTree(TKS_MESH_BUDGET, 300);
  Clip behind{};  // looks up from above: w = height - 10^6
  behind[0] = behind[5] = behind[14] = 1;
  behind[15] = -1e6;
  for (const Clip& clip : {window(-9, -9, -3, -3), behind, Clip{}}) {
    MeshOwner mesh;
    ASSERT_EQ(tks_view_mesh(tree_, clip.data(), &mesh.mesh), TKS_OK);
    // The zero matrix puts everything at x = y = w = 0, which is not outside.
    EXPECT_EQ(mesh.mesh.triangle_count > 0, clip == Clip{});
    EXPECT_EQ(mesh.mesh.vertex_count > 0, clip == Clip{});
  }
}

TEST_F(MeshTrees, RefuseWhatMakesNoSense) {
  Stream stream(bytes_);
  EXPECT_EQ(tks_decode_mesh_tree(nullptr, TKS_MESH_CODED, 0, &tree_), TKS_USAGE);
  EXPECT_EQ(tks_decode_mesh_tree(stream.get(), TKS_MESH_CODED, 0, nullptr), TKS_USAGE);
  const samples::Raster picture = samples::make({samples::Pattern::kRamp, 8, 8, 1, TKS_U8});
  const Bytes flat = encode(nullptr, &picture, lossless());
  Stream texture(flat);
  EXPECT_EQ(tks_decode_mesh_tree(texture.get(), TKS_MESH_CODED, 0, &tree_), TKS_USAGE);
  EXPECT_STRNE(tks_message(texture.get()), "");
  EXPECT_EQ(tree_, nullptr);
  makeTree(TKS_MESH_BUDGET, 100);
  MeshOwner mesh;
  EXPECT_EQ(tks_view_mesh(nullptr, Clip{}.data(), &mesh.mesh), TKS_USAGE);
  EXPECT_EQ(tks_view_mesh(tree_, nullptr, &mesh.mesh), TKS_USAGE);
  EXPECT_EQ(tks_view_mesh(tree_, Clip{}.data(), nullptr), TKS_USAGE);
  for (const double bad : {HUGE_VAL, std::numeric_limits<double>::quiet_NaN()})
    for (size_t i = 0; i < 16; ++i) {
      Clip clip = window(0, 0, 9, 9);
      clip[i] = bad;
      EXPECT_EQ(tks_view_mesh(tree_, clip.data(), &mesh.mesh), TKS_USAGE) << i;
    }
  tks_free_mesh_tree(nullptr);
}

// Whatever the matrix, what comes out is a part of the mesh.
TEST_F(MeshTrees, WildMatricesGivePartsOfTheMesh) {
  MeshOwner whole;
  makeTree(TKS_MESH_BUDGET, 500, &whole);
  const std::set<Triangle> all = whole.triangles();
  uint32_t state = 1;
  for (int round = 0; round < 300; ++round) {
    Clip clip;
    for (double& value : clip) {
      state = samples::hash(state, 1, 2);
      const int exponent = round % 3 == 0 ? static_cast<int>(state % 2000) - 1000 : 0;
      value =
          state % 5 == 0 ? 0 : std::ldexp(static_cast<double>(state) / 2147483648.0 - 1, exponent);
    }
    MeshOwner part;
    ASSERT_EQ(tks_view_mesh(tree_, clip.data(), &part.mesh), TKS_OK);
    const std::set<Triangle> seen = part.triangles();
    ASSERT_TRUE(std::includes(all.begin(), all.end(), seen.begin(), seen.end()));
  }
}

}  // namespace
}  // namespace tetrakis::test
