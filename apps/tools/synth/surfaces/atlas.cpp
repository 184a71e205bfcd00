// SPDX-License-Identifier: Apache-2.0
// Charts: grown triangle by triangle as long as they face one way, seen from there, and put on
// shelves by their heights.
#include "apps/tools/synth/surfaces/atlas.hpp"

#include <algorithm>
#include <numeric>

#include "codec/remesh/half_edges.hpp"

namespace tetrakis::tools::synth {
namespace {

class Grower {
 public:
  Grower(const TriangleMesh& shape, const ChartLimits& limits)
      : shape_(shape), limits_(limits), opposite_(gluedSides(shape.triangles).opposite) {
    charts.assign(shape.triangles.size(), kNone);
    for (uint32_t i = 0; i < charts.size(); ++i)
      if (charts[i] == kNone) grow(i);
  }
  bool isBorder(uint32_t triangle) const {
    for (size_t side = 0; side < 3; ++side) {
      const uint32_t other = opposite_[3 * size_t{triangle} + side];
      if (other == kNone || charts[other / 3] != charts[triangle]) return true;
    }
    return false;
  }
  std::vector<uint32_t> charts{};
  std::vector<Spot> directions{};  ///< that charts are seen from

 private:
  void grow(uint32_t first) {
    const auto chart = static_cast<uint32_t>(directions.size());
    const Spot facing = directionOf(areaNormal(shape_, shape_.triangles[first]));
    directions.push_back(facing);
    std::vector<uint32_t> grown{first};
    charts[first] = chart;
    for (size_t i = 0; i < grown.size(); ++i) {
      for (size_t side = 0; side < 3 && grown.size() < limits_.most_triangles; ++side) {
        const uint32_t other = opposite_[3 * size_t{grown[i]} + side];
        if (other == kNone || charts[other / 3] != kNone) continue;
        const uint32_t next = other / 3;
        if (dot(directionOf(areaNormal(shape_, shape_.triangles[next])), facing) <
            limits_.least_cosine)
          continue;
        charts[next] = chart;
        grown.push_back(next);
      }
    }
  }

  const TriangleMesh& shape_;
  ChartLimits limits_;
  std::vector<uint32_t> opposite_;  ///< for each side of a triangle the one glued to it
};

struct FlatBox {
  std::array<double, 2> low{1e300, 1e300}, high{-1e300, -1e300};
  double extent(size_t axis) const { return high[axis] - low[axis]; }
};

/// Flat, in the unit of the shape.
std::vector<std::array<double, 2>> seenFrom(const TriangleMesh& shape, const Grower& grown) {
  std::vector<std::array<double, 2>> places;
  for (size_t i = 0; i < shape.triangles.size(); ++i) {
    const Spot& facing = grown.directions[grown.charts[i]];
    const bool upright = std::abs(facing[2]) > 0.9;
    const Spot right = directionOf(cross(upright ? Spot{0, 1, 0} : Spot{0, 0, 1}, facing));
    const Spot up = cross(facing, right);
    for (const uint32_t corner : shape.triangles[i])
      places.push_back({dot(shape.points[corner], right), dot(shape.points[corner], up)});
  }
  return places;
}

/// Of each chart.
std::vector<FlatBox> boxesOf(const Atlas& atlas, size_t charts) {
  std::vector<FlatBox> boxes(charts);
  for (size_t i = 0; i < atlas.places.size(); ++i) {
    FlatBox& box = boxes[atlas.charts[i / 3]];
    for (size_t axis = 0; axis < 2; ++axis) {
      box.low[axis] = std::min(box.low[axis], atlas.places[i][axis]);
      box.high[axis] = std::max(box.high[axis], atlas.places[i][axis]);
    }
  }
  return boxes;
}

/// Corners of the boxes in a square of this side, shelf by shelf; none if they do not fit.
std::vector<std::array<double, 2>> shelved(const std::vector<FlatBox>& boxes,
                                           const std::vector<uint32_t>& order, double side,
                                           double gap) {
  std::vector<std::array<double, 2>> at(boxes.size());
  double x = gap, y = gap, shelf = 0;
  for (const uint32_t i : order) {
    const double width = boxes[i].extent(0) + gap, height = boxes[i].extent(1) + gap;
    if (x + width > side) {
      y += shelf;
      x = gap;
      shelf = 0;
    }
    if (x + width > side || y + height > side) return {};
    at[i] = {x, y};
    x += width;
    shelf = std::max(shelf, height);
  }
  return at;
}

}  // namespace

Atlas unwrap(const TriangleMesh& shape, const ChartLimits& limits) {
  constexpr double kGap = 1.0 / 200, kFirst = 1.02, kMore = 1.03;
  const Grower grown(shape, limits);
  Atlas atlas{seenFrom(shape, grown), grown.charts, {}};
  for (uint32_t i = 0; i < shape.triangles.size(); ++i) atlas.borders.push_back(grown.isBorder(i));
  const std::vector<FlatBox> boxes = boxesOf(atlas, grown.directions.size());
  std::vector<uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&boxes](uint32_t a, uint32_t b) {
    return boxes[a].extent(1) > boxes[b].extent(1);
  });
  double area = 0;
  for (const FlatBox& box : boxes) area += box.extent(0) * box.extent(1);
  double side = kFirst * std::sqrt(area);
  auto at = shelved(boxes, order, side, kGap * side);
  for (; at.empty(); at = shelved(boxes, order, side, kGap * side)) side *= kMore;
  for (size_t i = 0; i < atlas.places.size(); ++i) {
    const uint32_t chart = atlas.charts[i / 3];
    for (size_t axis = 0; axis < 2; ++axis)
      atlas.places[i][axis] =
          (atlas.places[i][axis] - boxes[chart].low[axis] + at[chart][axis]) / side;
  }
  return atlas;
}

}  // namespace tetrakis::tools::synth
