// SPDX-License-Identifier: Apache-2.0
// What cameras see of objects: triangles, and textures of patches.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "ratecontrol/pictures/patch_texture.hpp"
#include "ratecontrol/pictures/triangle_pictures.hpp"

namespace tetrakis {
namespace {

struct Drawn {
  std::vector<Vec3> points;
  std::vector<std::array<uint32_t, 3>> triangles;

  operator DrawnTriangles() const { return {points, triangles}; }
};

/// A square of two triangles, from -side to side, that much to the right, and so far away from a
/// camera that looks along -z.
Drawn square(double side, double right, double away) {
  Drawn mesh;
  for (const auto& [x, y] : {std::pair{-1, 1}, {-1, -1}, {1, -1}, {1, 1}})
    mesh.points.push_back({right + side * x, side * y, -away});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// Sees 10 to the left and to the right at a distance of 10; a pixel is 1 / 10 wide there.
Camera facing() {
  Camera camera;
  camera.eye = {0, 0, 0};
  camera.target = {0, 0, -1};
  camera.fov_y = 90;
  camera.width = camera.height = 200;
  return camera;
}

std::vector<Colour> painted(const TrianglePictures& pictures, const std::vector<SeenTriangle>& seen,
                            Colour colour) {
  return pictures.coloursOf(seen, [&](size_t) { return colour; });
}

double errorOf(const TrianglePictures& pictures, const Drawn& truth, const Drawn& other) {
  const std::vector<SeenTriangle> a = pictures.seenOf(truth), b = pictures.seenOf(other);
  const Colour black{};
  return pictures.errorBetween({a, painted(pictures, a, black)}, {b, painted(pictures, b, black)});
}

TEST(TrianglePictures, SeePlacesOfTriangles) {
  const TrianglePictures pictures({facing()});
  Drawn mesh = square(5, 0, 10);
  mesh.points[0][2] = mesh.points[3][2] = -20;  // it leans away
  mesh.points[0][1] = mesh.points[3][1] = 10;
  const std::vector<SeenTriangle> seen = pictures.seenOf(mesh);
  size_t triangles = 0;
  for (size_t i = 0; i < seen.size(); ++i) {
    if (seen[i].triangle == SeenTriangle::kSky) continue;
    ++triangles;
    const auto& corners = mesh.triangles[seen[i].triangle];
    Vec3 place{};
    const std::array<double, 3> weights = {1 - double{seen[i].second} - double{seen[i].third},
                                           seen[i].second, seen[i].third};
    for (size_t k = 0; k < 3; ++k) place = add(place, scale(mesh.points[corners[k]], weights[k]));
    const size_t pixel = i / TrianglePictures::kSamples;
    const double column = static_cast<double>(pixel % 200) + 0.5 - 100;
    const double row = 100 - static_cast<double>(pixel / 200) - 0.5;
    EXPECT_NEAR(place[0] / -place[2], column / 100, 0.0026);
    EXPECT_NEAR(place[1] / -place[2], row / 100, 0.0026);
  }
  // From 1/2 below to 1/2 above the middle; as wide as 1/4 to either side above, and 1/2 below.
  EXPECT_NEAR(static_cast<double>(triangles) / TrianglePictures::kSamples, 100 * 75, 150);
}

TEST(TrianglePictures, ShowWhatIsNearer) {
  const TrianglePictures pictures({facing()});
  Drawn both = square(5, 0, 10);
  const Drawn near = square(1, 0, 5);
  for (const Vec3& point : near.points) both.points.push_back(point);
  both.triangles.insert(both.triangles.begin(), {{4, 5, 6}, {4, 6, 7}});
  const std::vector<SeenTriangle> seen = pictures.seenOf(both);
  const size_t middle = TrianglePictures::kSamples * (200 * 100 + 100);
  EXPECT_LT(seen[middle].triangle, 2u);
  EXPECT_NEAR(seen[middle].samples, 0.5 * 4 * 40 * 40, 1);
  const size_t beside = TrianglePictures::kSamples * (200 * 100 + 140);
  EXPECT_GE(seen[beside].triangle, 2u);
  EXPECT_NE(seen[beside].triangle, SeenTriangle::kSky);
}

TEST(TrianglePictures, OutlinesErrAsFarAsTheyMove) {
  const TrianglePictures pictures({facing()});
  const Drawn truth = square(5, 0, 10);
  EXPECT_EQ(errorOf(pictures, truth, truth), 0);
  double before = 0;
  for (const double pixels : {0.3, 0.8, 2., 5.}) {
    const double error = errorOf(pictures, truth, square(5, pixels / 10, 10));
    EXPECT_GT(error, before) << pixels;
    before = error;
  }
  // Two edges of 100 pixels are off by 5, of some 105 x 100 pixels, between black and the sky.
  EXPECT_NEAR(before, 10. / 105 * 215 * 215, 500);
}

TEST(TrianglePictures, TellWhichCameraSeesNothing) {
  Camera away = facing();
  away.target = {0, 0, 1};
  const TrianglePictures pictures({facing(), away});
  EXPECT_EQ(pictures.firstBlind(pictures.seenOf(square(5, 0, 10))), 1u);
  EXPECT_EQ(pictures.firstBlind(pictures.seenOf(square(5, 0, -10))), 0u);
  away.weight = 0;
  const TrianglePictures one({facing(), away});
  EXPECT_EQ(one.firstBlind(one.seenOf(square(5, 0, 10))), 2u);
}

TEST(CamerasAround, SeeAllOfAnObject) {
  const auto cameras = camerasAround({{-1, -2, 0}, {3, 1, 1}});
  ASSERT_TRUE(cameras.ok());
  ASSERT_EQ(cameras->size(), 14u);
  const TrianglePictures pictures(*cameras);
  Drawn mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.points.push_back({corner & 1 ? 3. : -1., corner & 2 ? 1. : -2., corner & 4 ? 1. : 0.});
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};
  EXPECT_EQ(pictures.firstBlind(pictures.seenOf(mesh)), 14u);
}

TEST(PatchTexture, HasTheTexelsOfEachPatch) {
  // Two patches of 9 x 9 texels: the values are places, and in the second one 100 more.
  Texels texels{9, 18, 1, 8, {}};
  for (int patch = 0; patch < 2; ++patch)
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 9; ++x)
        texels.samples.push_back(static_cast<uint16_t>(100 * patch + 8 * x + y));
  const PatchTexture texture(texels, 3);
  for (uint32_t patch = 0; patch < 2; ++patch) {
    for (float u = 0; u <= 1; u += 0.17f) {
      for (float v = 0; v <= 1; v += 0.13f) {
        const float expected = 100 * static_cast<float>(patch) + 64 * u + 8 * v;
        EXPECT_NEAR(texture.at({patch, u, v, 0})[0], expected, 0.01);
        EXPECT_NEAR(texture.at({patch, u, v, 0.5})[2], expected, 3);  // sides are mirrored
        EXPECT_NEAR(texture.at({patch, u, v, 9})[1], expected, 26);
      }
    }
  }
}

TEST(PatchTexture, LiesOnTheSquaresOfItsPatch) {
  // Corners of the triangles of square (2, 1) of 4 x 4 in patch 3.
  const uint32_t first = 2 * (16 * 3 + 4 * 1 + 2);
  const auto at = [&](uint32_t triangle, float second, float third) {
    const PatchPlace place = patchPlaceOf({first + triangle, second, third, 8}, 2, 4);
    EXPECT_EQ(place.patch, 3u);
    EXPECT_EQ(place.level, 0);  // 8 texels on 8 samples
    return std::pair(place.u, place.v);
  };
  for (const uint32_t triangle : {0u, 1u}) EXPECT_EQ(at(triangle, 0, 0), std::pair(.5f, .25f));
  EXPECT_EQ(at(0, 1, 0), std::pair(.5f, .5f));
  EXPECT_EQ(at(0, 0, 1), std::pair(.75f, .5f));
  EXPECT_EQ(at(1, 1, 0), std::pair(.75f, .5f));
  EXPECT_EQ(at(1, 0, 1), std::pair(.75f, .25f));
  EXPECT_EQ(patchPlaceOf({first, 0, 0, 0.5}, 2, 4).level, 2);
}

}  // namespace
}  // namespace tetrakis
