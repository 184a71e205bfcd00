// SPDX-License-Identifier: Apache-2.0
// The packets of both components in one order: marginal allocation by the errors of pairs, and
// neighbours that are joined.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ratecontrol/allocation/allocation.hpp"
#include "ratecontrol/curves/component_curve.hpp"
#include "tests/support/rate_curves.hpp"

namespace tetrakis {
namespace {

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

/// A model off by a factor whose logarithm is linear is mended wherever nothing was measured.
TEST(CorrectedErrors, FollowFactorsThatChangeSlowly) {
  for (const auto& [heights, textures] :
       {std::pair<size_t, size_t>{1, 1}, {1, 6}, {7, 2}, {8, 9}}) {
    ErrorGrid model{heights, textures, {}};
    std::vector<double> truth, measured;
    for (size_t row = 0; row <= heights; ++row) {
      for (size_t column = 0; column <= textures; ++column) {
        const auto y = static_cast<double>(row), x = static_cast<double>(column);
        const bool original = row == heights && column == textures;
        model.errors.push_back(original ? 0 : 100 / (1 + y) + 50 / (1 + x));
        truth.push_back(model.errors.back() * std::exp(0.3 * y - 0.2 * x + 0.1));
      }
    }
    for (const size_t row : measuredPlaces(heights))
      for (const size_t column : measuredPlaces(textures))
        measured.push_back(truth[row * (textures + 1) + column]);
    const std::vector<double> corrected = correctedErrors(model, measured);
    ASSERT_EQ(corrected.size(), truth.size());
    for (size_t i = 0; i < truth.size(); ++i)
      EXPECT_NEAR(corrected[i], truth[i], 1e-9 * truth[i]) << i << " of " << heights;
  }
}

}  // namespace
}  // namespace tetrakis
