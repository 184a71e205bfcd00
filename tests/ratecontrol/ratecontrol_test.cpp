// SPDX-License-Identifier: Apache-2.0
// Convex hulls, marginal allocation, the audit of rate points, and what cameras see.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "conformance/samples/terrain_samples.hpp"
#include "ratecontrol/allocation.hpp"
#include "ratecontrol/audit.hpp"
#include "ratecontrol/hull.hpp"
#include "ratecontrol/pair_errors.hpp"
#include "ratecontrol/screen_points.hpp"

namespace tetrakis {
namespace {

std::vector<RatePoint> bumpyCurve(uint64_t step, double scale) {
  std::vector<RatePoint> points;
  for (uint64_t i = 0; i < 60; ++i) {
    const double bump = i % 3 == 1 ? 1.15 : 1.0;
    points.push_back({i * step, scale * std::exp(-0.1 * static_cast<double>(i)) * bump});
  }
  points.back().distortion = 0;
  return points;
}

double slope(const RatePoint& a, const RatePoint& b) {
  return (a.distortion - b.distortion) / static_cast<double>(b.bytes - a.bytes);
}

TEST(Hull, IsConvexAndBelowEveryPoint) {
  const std::vector<RatePoint> points = bumpyCurve(100, 5);
  const std::vector<RatePoint> hull = lowerHull(points, 0);
  ASSERT_GE(hull.size(), 3u);
  EXPECT_EQ(hull.front().bytes, points.front().bytes);
  EXPECT_EQ(hull.back().bytes, points.back().bytes);
  for (size_t i = 2; i < hull.size(); ++i)
    EXPECT_LE(slope(hull[i - 1], hull[i]), slope(hull[i - 2], hull[i - 1]));
  for (const RatePoint& point : points) {
    size_t i = 1;
    while (hull[i].bytes < point.bytes) ++i;
    const double chord = hull[i].distortion + slope(hull[i - 1], hull[i]) *
                                                  static_cast<double>(hull[i].bytes - point.bytes);
    EXPECT_GE(point.distortion, chord - 1e-9);
  }
}

TEST(Hull, KeepsPacketsApart) {
  const std::vector<RatePoint> hull = lowerHull(bumpyCurve(10, 5), 0.1);
  for (size_t i = 1; i + 1 < hull.size(); ++i) {
    EXPECT_GE(hull[i].bytes - hull[i - 1].bytes, kLeastPacket);
    EXPECT_GE(static_cast<double>(hull[i].bytes - hull[i - 1].bytes),
              0.1 * static_cast<double>(hull[i - 1].bytes) - 1);
  }
}

/// Whatever dips: packets cover the step once and in order, end at points, and where a point says
/// that bytes before it dip the packet over them does. Others are as few as can be.
TEST(PacketEnds, DipsHavePacketsOfTheirOwn) {
  for (uint32_t seed = 0; seed < 200; ++seed) {
    std::vector<RatePoint> points = bumpyCurve(1 + seed % 17, 5);
    for (size_t i = 1; i < points.size(); ++i)
      points[i].dips = samples::hash(static_cast<uint32_t>(i), seed, 1) % 7 == 0;
    const RatePoint &from = points[seed % 5], &to = points[points.size() - 1 - seed % 3];
    const std::vector<RatePoint> ends = packetEnds(points, from, to);
    ASSERT_FALSE(ends.empty());
    EXPECT_EQ(ends.back().bytes, to.bytes);
    uint64_t begin = from.bytes;
    bool before = true;
    for (const RatePoint& end : ends) {
      ASSERT_GT(end.bytes, begin);
      EXPECT_TRUE(before || end.dips) << "two packets that could be one";
      bool dips = false;
      for (const RatePoint& point : points)
        dips |= point.dips && point.bytes > begin && point.bytes <= end.bytes;
      EXPECT_EQ(end.dips, dips) << begin << " to " << end.bytes;
      if (!end.dips && end.bytes != to.bytes) {
        EXPECT_GE(end.bytes - begin, kLeastPacket);
      }
      begin = end.bytes;
      before = end.dips;
    }
  }
}

ComponentCurve curveOf(Component component, const std::vector<RatePoint>& points) {
  ComponentCurve curve{lowerHull(points, 0), {}};
  for (size_t i = 1; i < curve.points.size(); ++i) {
    curve.packets.push_back(
        {component, false, 0, curve.points[i - 1].bytes, curve.points[i].bytes, {}});
  }
  return curve;
}

/// Mean squared error at so many bytes, packets being divisible.
double squareAt(const ComponentCurve& curve, uint64_t bytes) {
  size_t i = 1;
  while (i + 1 < curve.points.size() && curve.points[i].bytes < bytes) ++i;
  const RatePoint &a = curve.points[i - 1], &b = curve.points[i];
  return a.distortion - slope(a, b) * static_cast<double>(std::min(bytes, b.bytes) - a.bytes);
}

std::vector<double> nodesOf(const ComponentCurve& curve) {
  std::vector<double> nodes;
  for (size_t i = 0; i + 1 < curve.points.size(); i += 4)
    nodes.push_back(curve.points[i].distortion);
  return nodes;
}

/// Errors of a picture that are as `model` says of the squared errors of both.
template <class Model>
PairErrors errorsBy(const std::array<ComponentCurve, kComponents>& curves, Model&& model) {
  PairNodes nodes = {nodesOf(curves[0]), nodesOf(curves[1])};
  std::vector<double> errors;
  for (size_t g = 0; g <= nodes.heights.size(); ++g)
    for (size_t t = 0; t <= nodes.textures.size(); ++t)
      errors.push_back(model(g < nodes.heights.size() ? nodes.heights[g] : 0,
                             t < nodes.textures.size() ? nodes.textures[t] : 0));
  return {std::move(nodes), std::move(errors)};
}

/// At most `bound` above the best split of any prefix.
template <class Model>
void expectBestSplits(Model&& model, double bound) {
  const std::array<ComponentCurve, kComponents> curves = {
      curveOf(Component::kGeometry, bumpyCurve(70, 9)),
      curveOf(Component::kTexture, bumpyCurve(130, 40))};
  const PairErrors errors = errorsBy(curves, model);
  const auto error = [&](uint64_t first, uint64_t second) {
    return errors.at(errors.heightsAt(squareAt(curves[0], first)),
                     errors.textureAt(squareAt(curves[1], second)));
  };
  std::array<uint64_t, kComponents> sent = {};
  double before = error(0, 0);
  for (const Packet& packet : allocate(curves, errors)) {
    const auto component = static_cast<size_t>(packet.component);
    ASSERT_EQ(packet.begin, sent[component]);
    sent[component] = packet.end;
    const uint64_t total = sent[0] + sent[1];
    const double ours = error(sent[0], sent[1]);
    EXPECT_LE(ours, before + 1e-9) << "more bytes are worse";
    before = ours;
    for (uint64_t first = 0; first <= std::min<uint64_t>(total, curves[0].points.back().bytes);
         first += 10) {
      if (total - first > curves[1].points.back().bytes) continue;
      EXPECT_LE(ours, error(first, total - first) * (1 + bound) + 1e-9) << total << " bytes";
    }
  }
  EXPECT_EQ(sent[0], curves[0].points.back().bytes);
  EXPECT_EQ(sent[1], curves[1].points.back().bytes);
}

TEST(Allocation, NoSplitOfAnyPrefixIsMuchBetterWhereErrorsAdd) {
  expectBestSplits([](double h, double t) { return h + t; }, 0.03);
}

/// Texels in the wrong place are worth little: the slopes of either depend on how far the other is.
TEST(Allocation, NoSplitOfAnyPrefixIsMuchBetterWhereErrorsInteract) {
  expectBestSplits(
      [](double h, double t) {
        const double moved = 1 - std::exp(-h / 3);
        return t + 60 * moved * (50 - t) / 50;
      },
      0.05);
}

TEST(Allocation, OpeningsComeBeforeWhatNeedsThem) {
  std::array<ComponentCurve, kComponents> curves = {
      curveOf(Component::kGeometry, {{0, 10}, {1000, 10}, {1100, 1}, {1300, 0}}),
      curveOf(Component::kTexture, bumpyCurve(130, 1e-3))};
  curves[0] = {{{0, 10}, {1000, 10}, {1100, 1}, {1300, 0}}, {}, 1};
  for (size_t i = 1; i < 4; ++i)
    curves[0].packets.push_back({Component::kGeometry,
                                 false,
                                 0,
                                 curves[0].points[i - 1].bytes,
                                 curves[0].points[i].bytes,
                                 {}});
  const PairErrors errors({{10, 1}, {1e-3}}, {10.001, 10, 1.001, 1, 1e-3, 0});
  EXPECT_EQ(allocate(curves, errors).front().component, Component::kGeometry);
}

TEST(PairErrors, MeetsItsNodesAndStaysBetweenThem) {
  const PairErrors errors({{100, 10, 1}, {50, 5}}, {90, 70, 65, 60, 30, 20, 55, 12, 2, 51, 8, 0});
  const auto at = [&](double h, double t) {
    return errors.at(errors.heightsAt(h), errors.textureAt(t));
  };
  EXPECT_DOUBLE_EQ(at(100, 50), 90);
  EXPECT_DOUBLE_EQ(at(1e9, 1e9), 90);  // nothing is worse than the first bytes
  EXPECT_DOUBLE_EQ(at(10, 5), 30);
  EXPECT_DOUBLE_EQ(at(1, 0), 2);
  EXPECT_DOUBLE_EQ(at(0, 0), 0);
  EXPECT_DOUBLE_EQ(at(0.5, 0), 1);  // in proportion behind the last node
  EXPECT_NEAR(at(std::sqrt(1000), 50), std::sqrt(90.0 * 60), 1e-9);
  for (double h = 200; h > 1e-3; h *= 0.8)
    for (double t = 80; t > 1e-3; t *= 0.8) EXPECT_LE(at(h * 0.9, t * 0.9), at(h, t) + 1e-9);
}

/// Errors that are a power of the squared error stay one behind the last node.
TEST(PairErrors, GoOnAsTheyFell) {
  constexpr double kPower = 1.4, kOriginal = 3;
  const std::vector<double> squares = {1000, 100, 10};
  const auto error = [&](double square) { return kOriginal + std::pow(square, kPower); };
  std::vector<double> by_heights, by_textures;
  for (const double square : squares) by_textures.push_back(error(square));
  by_textures.push_back(kOriginal);
  by_textures.insert(by_textures.end(), by_textures.begin(), by_textures.begin() + 4);
  for (const double square : squares) by_heights.insert(by_heights.end(), 2, error(square));
  by_heights.insert(by_heights.end(), 2, kOriginal);
  const PairErrors textures({{1}, squares}, by_textures), heights({squares, {1}}, by_heights);
  for (const double square : {9., 5., 1., 0.1}) {
    EXPECT_NEAR(textures.at(textures.heightsAt(1), textures.textureAt(square)), error(square),
                1e-9);
    EXPECT_NEAR(heights.at(heights.heightsAt(square), heights.textureAt(1)), error(square), 1e-9);
  }
}

TEST(JoinNeighbours, KeepsBytesQualityStepsAndWholePackets) {
  const auto packet = [](Component component, bool whole, int quality, uint64_t begin,
                         uint64_t end) {
    return Packet{component, whole, static_cast<uint8_t>(quality), begin, end, {}};
  };
  const Component g = Component::kGeometry, t = Component::kTexture;
  const std::vector<Packet> packets = {
      packet(g, false, 90, 0, 10),   packet(t, false, 99, 0, 20),   // the first of each
      packet(t, false, 98, 20, 30),  packet(t, false, 97, 30, 50),  // two steps: one packet
      packet(t, false, 96, 50, 60),  packet(g, false, 90, 10, 20),  // the other track ends it
      packet(t, true, 96, 60, 70),   packet(t, false, 96, 70, 80),  // whole: by itself
      packet(t, false, 93, 80, 100),                                // three steps are too many
      packet(g, false, 89, 20, 30),  packet(g, false, 88, 30, 50)};
  const std::vector<Packet> joined = joinNeighbours(packets);
  const std::vector<std::pair<uint64_t, int>> expected = {
      {10, 90}, {20, 99}, {50, 97}, {60, 96}, {20, 90}, {70, 96}, {80, 96}, {100, 93}, {50, 88}};
  ASSERT_EQ(joined.size(), expected.size());
  std::array<uint64_t, kComponents> sent = {};
  for (size_t i = 0; i < joined.size(); ++i) {
    EXPECT_EQ(joined[i].end, expected[i].first);
    EXPECT_EQ(joined[i].quality, expected[i].second);
    EXPECT_EQ(joined[i].whole, i == 5);
    uint64_t& begin = sent[static_cast<size_t>(joined[i].component)];
    EXPECT_EQ(joined[i].begin, begin);
    begin = joined[i].end;
  }
}

TEST(JoinNeighbours, TracksOfRegionsStayApart) {
  std::vector<Packet> packets(4);
  for (uint32_t i = 0; i < 4; ++i) packets[i] = {Component::kTexture, false, 80, 0, 9, i / 2};
  packets[1].begin = packets[3].begin = 9;
  packets[1].end = packets[3].end = 18;
  const std::vector<Packet> joined = joinNeighbours(packets);
  ASSERT_EQ(joined.size(), 3u);  // the first packet of a component states its quality early
  EXPECT_EQ(joined[1].track, 0u);
  EXPECT_EQ(joined[2].track, 1u);
  EXPECT_EQ(joined[2].end, 18u);
}

TEST(Audit, TinyTracksGetAPointForEveryRecord) {
  EncodedTrack track;
  track.codeword.resize(9);
  track.points = {{0, 100}, {9, 0}};
  const std::vector<double> truth = {100, 90, 95, 80, 80, 50, 50.1, 40, 10, 0};
  const auto points = audit(track, {4}, [&](uint64_t bytes) { return truth[bytes]; });
  std::vector<uint64_t> bytes;
  for (const RatePoint& p : points) bytes.push_back(p.bytes);
  EXPECT_EQ(bytes, (std::vector<uint64_t>{0, 1, 3, 5, 7, 8, 9}));
  EXPECT_TRUE(points[2].dips);   // 95 after 90
  EXPECT_FALSE(points[4].dips);  // 50.1 after 50 is too little to see
}

/// Noise takes more bytes than a small track can afford to measure one by one.
TEST(Audit, SmallTracksDecodeABoundedNumberOfSamples) {
  for (const uint64_t samples : {uint64_t{4000}, kSmallSamples}) {
    EncodedTrack track;
    track.codeword.resize(40000);
    for (uint64_t i = 0; i <= 1000; ++i)
      track.points.push_back({40 * i, static_cast<double>(1001 - i)});
    uint64_t measured = 0;
    const auto points = audit(track, {samples}, [&](uint64_t bytes) {
      ++measured;
      return 1001 - static_cast<double>(bytes) / 40;
    });
    EXPECT_LE(measured * samples, (uint64_t{1} << 23) + 2 * samples * track.points.size());
    EXPECT_EQ(points[1].bytes, 1u) << "the first bytes are measured one by one";
  }
}

TEST(Audit, LargeTracksAreCorrectedOnlyWithoutABudget) {
  EncodedTrack track;
  track.codeword.resize(5900);
  track.points = bumpyCurve(100, 1000);
  const auto twice = [&](uint64_t bytes) { return 2 * track.points[bytes / 100].distortion; };
  EXPECT_DOUBLE_EQ(audit(track, {1 << 20, 9000}, twice).front().distortion, 1000);
  EXPECT_NEAR(audit(track, {1 << 20}, twice).front().distortion, 2000, 1e-6);
}

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

/// Errors of outlines of a plain that lies too high, by falling metres.
std::vector<double> errorsOfEdges(size_t points, size_t enough) {
  Camera askew = lookingAt({50, 30, 23}, {0, 0, 0});  // no outline along rows of pixels
  askew.width = askew.height = 2048;
  const ScreenPoints screen({askew}, points);
  const Texels texels = stripes(16);
  const ScreenTexture texture(texels, texels.extent());
  std::vector<std::vector<SeenPoint>> seen;
  std::vector<double> squares;
  for (float shift = 4; shift > 0.05f; shift /= 2) {
    Relief relief = walled(0);
    for (float& height : relief.heights) height += shift;
    seen.push_back(screen.seenOf(GroundRays(relief), texels.extent()));
    squares.push_back(double{shift} * double{shift});
  }
  const auto here = screen.seenOf(GroundRays(walled(0)), texels.extent());
  const auto colours = screen.coloursOf(here, texture);
  std::vector<std::vector<Colour>> moved;
  for (const auto& surface : seen) moved.push_back(screen.coloursOf(surface, texture));
  std::vector<ScreenPoints::Pictures> pictures;
  for (size_t g = 0; g < seen.size(); ++g) pictures.push_back({seen[g], moved[g]});
  return screen.errorsOfOutlines({here, colours}, pictures, squares, enough);
}

/// Few points see how little an outline moves at last; those that saw more of it say how much.
TEST(ScreenPoints, FewPointsKnowTheErrorsOfOutlines) {
  const std::vector<double> many = errorsOfEdges(100000, 0), few = errorsOfEdges(2000, 64);
  ASSERT_EQ(many.size(), few.size());
  for (size_t g = 0; g < many.size(); ++g) {
    EXPECT_GT(many[g], 0);
    EXPECT_NEAR(few[g], many[g], 0.2 * many[g]) << g;
  }
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
