// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/synth/surfaces/level_set.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace tetrakis::tools::synth {
namespace {

/// Ways from one corner of a cube to the opposite one, bit by bit: six tetrahedra that fit those of
/// the cubes beside.
constexpr std::array<std::array<uint32_t, 4>, 6> kTetrahedra{
    {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};

class Marcher {
 public:
  Marcher(const Field& field, const Cells& cells) : cells_(cells), row_(cells.side + 1) {
    values_.reserve(row_ * row_ * row_);
    for (size_t i = 0; i < row_ * row_ * row_; ++i) values_.push_back(field(placeOf(i)));
    for (size_t z = 0; z < cells.side; ++z)
      for (size_t y = 0; y < cells.side; ++y)
        for (size_t x = 0; x < cells.side; ++x) march(x + row_ * (y + row_ * z));
  }
  TriangleMesh shape{};

 private:
  Spot placeOf(size_t i) const {
    const double step = 2 * cells_.half / cells_.side;
    return {step * static_cast<double>(i % row_) - cells_.half,
            step * static_cast<double>(i / row_ % row_) - cells_.half,
            step * static_cast<double>(i / row_ / row_) - cells_.half};
  }
  void march(size_t first) {
    const auto corner = [&](uint32_t bits) {
      return first + (bits & 1) + row_ * ((bits >> 1 & 1) + row_ * (bits >> 2));
    };
    for (const auto& tetrahedron : kTetrahedra) {
      std::array<size_t, 4> inside{}, outside{};
      size_t insides = 0, outsides = 0;
      for (const uint32_t bits : tetrahedron) {
        const size_t i = corner(bits);
        if (values_[i] < 0)
          inside[insides++] = i;
        else
          outside[outsides++] = i;
      }
      if (insides > 0 && outsides > 0) cut(inside, insides, outside, outsides);
    }
  }
  void cut(const std::array<size_t, 4>& in, size_t ins, const std::array<size_t, 4>& out,
           size_t outs) {
    const Spot outward = placeOf(out[0]) - placeOf(in[0]);
    if (ins == 1)
      add({between(in[0], out[0]), between(in[0], out[1]), between(in[0], out[2])}, outward);
    if (outs == 1)
      add({between(in[0], out[0]), between(in[1], out[0]), between(in[2], out[0])}, outward);
    if (ins == 2) {
      const uint32_t a = between(in[0], out[0]), b = between(in[0], out[1]);
      const uint32_t c = between(in[1], out[1]), d = between(in[1], out[0]);
      add({a, b, c}, outward);
      add({a, c, d}, outward);
    }
  }
  /// The way out of the tetrahedron tells which side of the triangle is outside.
  void add(Triangle t, const Spot& outward) {
    if (dot(areaNormal(shape, t), outward) < 0) std::swap(t[1], t[2]);
    shape.triangles.push_back(t);
  }
  uint32_t between(size_t in, size_t out) {
    constexpr double kNearest = 0.05;  // to a corner: no triangle without area
    const auto [least, most] = std::minmax(in, out);
    const auto [found, is_new] = numbers_.try_emplace(least * values_.size() + most,
                                                      static_cast<uint32_t>(shape.points.size()));
    if (is_new) {
      const double way = values_[in] / (values_[in] - values_[out]);
      const Spot from = placeOf(in);
      shape.points.push_back(from +
                             std::clamp(way, kNearest, 1 - kNearest) * (placeOf(out) - from));
    }
    return found->second;
  }

  Cells cells_;
  size_t row_;
  std::vector<double> values_{};
  std::unordered_map<size_t, uint32_t> numbers_{};
};

/// Moves a point along the gradient to where the field is zero.
Spot onto(const Field& field, const Spot& point, double step) {
  const double value = field(point);
  Spot slope{};
  for (size_t axis = 0; axis < 3; ++axis) {
    Spot beside = point;
    beside[axis] += step;
    slope[axis] = (field(beside) - value) / step;
  }
  const double square = dot(slope, slope);
  return square > 0 ? point - (value / square) * slope : point;
}

/// Each point goes to the middle of its neighbours, and back onto the surface.
void relax(const Field& field, double step, TriangleMesh& shape) {
  std::vector<Spot> sums(shape.points.size());
  std::vector<double> counts(shape.points.size());
  for (const Triangle& t : shape.triangles) {
    for (size_t k = 0; k < 3; ++k) {
      sums[t[k]] = sums[t[k]] + shape.points[t[(k + 1) % 3]] + shape.points[t[(k + 2) % 3]];
      counts[t[k]] += 2;
    }
  }
  for (size_t i = 0; i < sums.size(); ++i)
    shape.points[i] = onto(field, (1 / counts[i]) * sums[i], step);
}

}  // namespace

TriangleMesh levelSet(const Field& field, const Cells& cells) {
  constexpr int kRounds = 3;
  constexpr double kFine = 0.01;
  TriangleMesh shape = Marcher(field, cells).shape;
  const double step = kFine * cells.half / cells.side;
  for (int i = 0; i < kRounds; ++i) relax(field, step, shape);
  return shape;
}

}  // namespace tetrakis::tools::synth
