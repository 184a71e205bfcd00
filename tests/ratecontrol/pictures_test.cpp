// SPDX-License-Identifier: Apache-2.0
// What cameras see: rays, points of pictures, and outlines.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "conformance/samples/terrain_samples.hpp"
#include "ratecontrol/pictures/ground_rays.hpp"
#include "ratecontrol/pictures/picture_errors.hpp"

namespace tetrakis {
namespace {

/// A plain of 65 x 65 samples a metre apart, with a wall of that height along the middle row.
Relief walled(float height) {
  Relief relief{{65, 65, 1, 1, 1}, std::vector<float>(size_t{65} * 65)};
  for (size_t x = 0; x < 65; ++x) relief.heights[size_t{32} * 65 + x] = height;
  return relief;
}

Camera lookingAt(std::array<double, 3> eye, std::array<double, 3> target) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.up = {0, 1, -0.01};
  return camera;
}

TEST(GroundRays, MeetTheGroundWhereItIs) {
  const GroundRays ground(walled(0));
  for (double x = -31.7; x < 32; x += 7.3) {
    for (double z = -31.2; z < 32; z += 5.9) {
      const Vec3 eye{3, 40, 50};
      const auto hit = ground.hit({eye, subtract({x, 0, z}, eye)});
      ASSERT_TRUE(hit);
      EXPECT_NEAR(hit->column, x + 32, 1e-9);
      EXPECT_NEAR(hit->row, z + 32, 1e-9);
      EXPECT_NEAR(hit->far, 1, 1e-9);
    }
  }
  EXPECT_FALSE(ground.hit({{0, 10, 0}, {0, 1, 0}}));
  EXPECT_FALSE(ground.hit({{0, 10, 100}, {0, 0, 1}}));
  EXPECT_EQ(*GroundRays(walled(7)).heightAt(0.25, 0.5), 3.5);
  EXPECT_FALSE(ground.heightAt(33, 0));
}

/// Ground as flat as a lake at the bottom of its bounds stops every ray.
TEST(GroundRays, MeetTheLowestGround) {
  for (const float height : {0.f, 0.3f, 1234.56f, -4000.1f}) {
    Relief relief = walled(0);
    std::fill(relief.heights.begin(), relief.heights.end(), height);
    const GroundRays ground(relief);
    for (uint32_t i = 0; i < 2000; ++i) {
      const double x = samples::hash(i, 1, 3) % 640 / 10.0 - 32;
      const double z = samples::hash(i, 2, 3) % 640 / 10.0 - 32;
      const Vec3 eye{50, height + 30.0, 23};
      const auto hit = ground.hit({eye, subtract({x, height, z}, eye)});
      ASSERT_TRUE(hit) << height << " at " << x << ", " << z;
      EXPECT_NEAR(hit->far, 1, 1e-6);
    }
  }
}

/// A slope is the same ground if only some heights of it are given, up to the border.
TEST(GroundRays, MeetHeightsThatAreSeveralSamplesApart) {
  for (const uint32_t step : {1u, 2u, 4u, 16u, 64u}) {
    Relief relief{{50, 34, 3, 5, 1}, {}, step};
    const Extent grid = relief.extent();
    for (uint32_t y = 0; y < grid.height; ++y)
      for (uint32_t x = 0; x < grid.width; ++x)
        relief.heights.push_back(static_cast<float>(step * (2 * x + y)));
    const GroundRays ground(relief);
    const auto hit = ground.hit({{10, 200, 20}, {-0.1, -1, 0.1}});
    ASSERT_TRUE(hit) << step;
    EXPECT_NEAR(hit->slope_c, 2, 1e-9);
    EXPECT_NEAR(hit->slope_r, 1, 1e-9);
    EXPECT_NEAR(hit->at + 2 * hit->column + hit->row, 200 - hit->far, 1e-9);
    EXPECT_NEAR(*ground.heightAt(73.4, 82.4), 2 * (24.5 + 73.4 / 3) + 16.5 + 82.4 / 5, 1e-9);
    EXPECT_FALSE(ground.heightAt(73.6, 0)) << step;
    EXPECT_FALSE(ground.heightAt(0, 82.6)) << step;
  }
}

/// Brute force: the ray is above the ground until it meets the triangle that is found. It starts
/// above the grid, as from beside it rays also come in below the ground.
TEST(GroundRays, FindTheFirstTriangle) {
  Relief relief{{33, 20, 3, 5, 1}, std::vector<float>(size_t{33} * 20)};
  for (uint32_t i = 0; i < relief.heights.size(); ++i)
    relief.heights[i] = static_cast<float>(samples::hash(i, 5, 1) % 30);
  const GroundRays ground(relief);
  const auto heightOn = [](const GroundHit& hit) {
    return hit.at + hit.slope_c * hit.column + hit.slope_r * hit.row;
  };
  size_t hits = 0;
  for (uint32_t i = 0; i < 400; ++i) {
    const auto random = [&](uint32_t k) { return samples::hash(i, k, 9) % 1000 / 500.0 - 1; };
    const Ray ray{{45 * random(1), 31 + 20 * (random(2) + 1), 45 * random(3)},
                  {random(4), -0.3 - 0.3 * (random(5) + 1), random(6)}};
    const auto hit = ground.hit(ray);
    const double end = hit ? hit->far : 300;
    if (hit) {
      ++hits;
      EXPECT_NEAR(heightOn(*hit), ray.origin[1] + hit->far * ray.direction[1], 1e-6);
    }
    for (double t = 0; t < end - 0.02; t += 0.01) {
      const Vec3 p = add(ray.origin, scale(ray.direction, t));
      const auto height = ground.heightAt(p[0], p[2]);
      ASSERT_GE(p[1], height.value_or(-1e9) - 0.2) << "ray " << i << " at " << t;
    }
  }
  EXPECT_GT(hits, 100u);
}

Texels stripes(uint32_t period) {
  Texels texels{64, 64, 1, 8, std::vector<uint16_t>(64 * 64)};
  for (uint32_t i = 0; i < 64 * 64; ++i)
    texels.samples[i] = (i % 64) / (period / 2) % 2 == 0 ? 60 : 180;
  return texels;
}

/// What a wall hides counts nothing: no point of the picture lies behind it.
TEST(ScreenPoints, HiddenGroundIsNotSeen) {
  const ScreenPoints points({lookingAt({0, 3, 40}, {0, 2, 0})}, 2000);
  const auto behind = [&](float wall) {
    const auto seen = points.seenOf(GroundRays(walled(wall)), {64, 64});
    return std::count_if(seen.begin(), seen.end(),
                         [](const SeenPoint& s) { return s.ground && s.v < 31.0 / 64; });
  };
  EXPECT_GT(behind(0), 50);
  EXPECT_EQ(behind(20), 0);
}

TEST(ScreenPoints, CamerasThatSeeNothingAreNamed) {
  const ScreenPoints points(
      {lookingAt({0, 30, 40}, {0, 0, 0}), lookingAt({0, 30, 40}, {0, 60, 90})}, 200);
  EXPECT_EQ(points.blindCameras(points.seenOf(GroundRays(walled(1)), {64, 64})),
            std::vector<size_t>{1});
}

/// Error of the picture where the plain is at another height.
double errorOfShift(const Texels& texels, float shift, const std::vector<Camera>& cameras) {
  const ScreenPoints points(cameras, 3000);
  const ScreenTexture texture(texels, texels.extent());
  const auto picture = [&](float height) {
    Relief relief = walled(0);
    std::fill(relief.heights.begin(), relief.heights.end(), height);
    return points.seenOf(GroundRays(relief), texels.extent());
  };
  const auto here = picture(0), there = picture(shift);
  const auto colours = points.coloursOf(here, texture), moved = points.coloursOf(there, texture);
  return points.errorInside({here, colours}, {there, moved});
}

TEST(ScreenPoints, HeightErrorsMoveTheTexture) {
  const std::vector<Camera> aside = {lookingAt({60, 40, 0}, {0, 0, 0})};
  EXPECT_EQ(errorOfShift(stripes(16), 0, aside), 0);
  double before = 0;
  for (const float shift : {0.25f, 0.5f, 1.0f, 2.0f}) {
    const double error = errorOfShift(stripes(16), shift, aside);
    EXPECT_GT(error, 1.5 * before);
    before = error;
  }
  EXPECT_GT(errorOfShift(stripes(8), 0.5, aside), errorOfShift(stripes(32), 0.5, aside));
  Texels flat = stripes(16);
  std::fill(flat.samples.begin(), flat.samples.end(), uint16_t{90});
  EXPECT_NEAR(errorOfShift(flat, 5, aside), 0, 1e-6);
}

/// Eyes that look down at a corner of a plain: no outline runs along rows of pixels.
Camera askew() {
  Camera camera = lookingAt({50, 30, 23}, {0, 0, 0});
  camera.width = camera.height = 2048;
  return camera;
}

GroundRays plainAt(float height) {
  Relief relief = walled(0);
  std::fill(relief.heights.begin(), relief.heights.end(), height);
  return GroundRays(std::move(relief));
}

/// What many points see where one picture shows ground and the other one sky.
double seenAtOutlines(const GroundRays& truth, const GroundRays& other, const Texels& texels) {
  const ScreenPoints points({askew()}, 50000);
  const ScreenTexture texture(texels, texels.extent());
  const auto here = points.seenOf(truth, texels.extent());
  const auto there = points.seenOf(other, texels.extent());
  const auto colours = points.coloursOf(here, texture), moved = points.coloursOf(there, texture);
  double squares = 0, covered = 0;
  for (size_t i = 0; i < here.size(); ++i) {
    covered += here[i].ground;
    if (here[i].ground != there[i].ground) squares += squaresBetween(colours[i], moved[i]) / 3;
  }
  return squares / covered;
}

Texels grey() {
  return {64, 64, 1, 8, std::vector<uint16_t>(64 * 64, 90)};
}

/// Beyond some pixels the smoothing of pixels hardly counts, and points see what columns say.
TEST(Outlines, ErrAsPointsSee) {
  const GroundRays truth = plainAt(0);
  const Outlines outlines({askew()}, 256, truth, {grey(), grey().extent()}, grey().extent());
  for (const float shift : {2.f, 1.f, -1.f, -4.f}) {
    const double seen = seenAtOutlines(truth, plainAt(shift), grey());
    EXPECT_GT(seen, 0);
    EXPECT_NEAR(outlines.errorOf(plainAt(shift)), seen, 0.1 * seen) << shift;
  }
}

/// However small: what counts of a shift below a pixel lies between a quarter and all of it, and
/// falls with its square before it falls with itself.
TEST(Outlines, FollowSmallShifts) {
  const Texels texels = stripes(16);
  const Outlines outlines({askew()}, 256, plainAt(0), {texels, texels.extent()}, texels.extent());
  EXPECT_EQ(outlines.errorOf(plainAt(0)), 0);
  double before = outlines.errorOf(plainAt(1));
  for (float shift = 0.5f; shift > 0.001f; shift /= 2) {
    const double error = outlines.errorOf(plainAt(shift));
    EXPECT_GT(error, before / 4.2) << shift;
    EXPECT_LT(error, before / 1.8) << shift;
    before = error;
  }
}

TEST(Outlines, OfPicturesWithoutSkyAreNone) {
  const Texels texels = stripes(16);
  const auto outlinesOf = [&](const std::vector<Camera>& cameras) {
    return Outlines(cameras, 100, plainAt(0), {texels, texels.extent()}, texels.extent());
  };
  EXPECT_EQ(outlinesOf({lookingAt({0, 20, 1}, {0, 0, 0})}).errorOf(plainAt(1)), 0);
  EXPECT_EQ(outlinesOf({lookingAt({0, 30, 40}, {0, 60, 90})}).errorOf(plainAt(1)), 0);
  Camera away = lookingAt({0, 20, 1}, {0, 0, 0});
  away.weight = 3;
  const double alone = outlinesOf({askew()}).errorOf(plainAt(1));
  EXPECT_NEAR(outlinesOf({askew(), away}).errorOf(plainAt(1)), alone / 4, 0.05 * alone);
}

/// The error over two cameras is the mean of their errors, which are squares, by their weights.
TEST(ScreenPoints, CamerasAverageTheirSquares) {
  Camera aside = lookingAt({60, 40, 0}, {0, 0, 0}), above = lookingAt({1, 80, 0}, {0, 0, 0});
  aside.weight = 3;
  const double a = errorOfShift(stripes(16), 1, {aside});
  const double b = errorOfShift(stripes(16), 1, {above});
  EXPECT_NEAR(errorOfShift(stripes(16), 1, {aside, above}), (3 * a + b) / 4, 0.06 * a);
  above.weight = 0;
  EXPECT_NEAR(errorOfShift(stripes(16), 1, {aside, above}), a, 1e-9);
}

/// From far away fine stripes are grey: their errors do not survive on the screen.
TEST(ScreenPoints, FarTexturesAreSeenAtCoarseLevels) {
  const auto errorOfGrey = [](uint32_t period, double height) {
    const ScreenPoints points({lookingAt({0, height, 1}, {0, 0, 0})}, 3000);
    const Texels texels = stripes(period);
    Texels grey = texels;
    std::fill(grey.samples.begin(), grey.samples.end(), uint16_t{120});
    const auto seen = points.seenOf(GroundRays(walled(0)), texels.extent());
    const auto colours = points.coloursOf(seen, {texels, texels.extent()});
    const auto plain = points.coloursOf(seen, {grey, texels.extent()});
    return points.errorInside({seen, colours}, {seen, plain});
  };
  EXPECT_NEAR(errorOfGrey(2, 40), 3600 / 3, 100);  // a triangle wave between texels
  EXPECT_LT(errorOfGrey(2, 4000), 100);
  EXPECT_GT(errorOfGrey(32, 4000), 1500);
}

}  // namespace
}  // namespace tetrakis
