// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/base_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <optional>

#include "conformance/reference_decoder/place_decoder.hpp"
#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {
namespace {

Vector sum(int64_t s, const Vector& a, int64_t t, const Vector& b) {
  return {s * a[0] + t * b[0], s * a[1] + t * b[1], s * a[2] + t * b[2]};
}

int64_t dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

int64_t floorDiv(int64_t a, int64_t b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

Vector rounded(Vector a, int bits) {
  for (int64_t& value : a) value = floorDiv(value + (int64_t{1} << bits) / 2, int64_t{1} << bits);
  return a;
}

int64_t floorRoot(int64_t x) {
  int64_t low = 0, high = int64_t{1} << 31;  // low² <= x < high²
  while (high - low > 1) {
    const int64_t middle = (low + high) / 2;
    (middle * middle <= x ? low : high) = middle;
  }
  return low;
}

Vector unit(const Vector& a) {
  const int64_t largest = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
  if (largest == 0) return {};
  const int k = static_cast<int>(std::bit_width(static_cast<uint64_t>(largest))) - 30;
  Vector b = k > 0 ? rounded(a, k) : sum(int64_t{1} << -k, a, 0, a);
  const int64_t length = floorRoot(dot(b, b));
  for (int64_t& value : b) value = floorDiv((value << 15) + length, 2 * length);
  return b;
}

/// So many corners, or sides, behind one of the same patch.
int behind(int corner, int i) {
  return corner / 4 * 4 + (corner + i) % 4;
}

/// FORMAT 11: the corners, one after the other.
class Corners {
 public:
  Corners(std::span<const uint8_t> codeword, int bits, const Forest& forest)
      : decoder_(codeword),
        places_(decoder_, 3, bits),
        forest_(forest),
        told_(size_t(4) * forest.patches()) {}

  std::vector<Vector> run() {
    std::vector<Vector> corners;
    for (int c = 0; c < static_cast<int>(told_.size()); ++c) {
      const int lowest = forest_.lowestCorner(c);
      told_[c] = lowest < c ? told_[lowest] : tell(c);
      corners.push_back(told_[c].at);
    }
    return corners;
  }

 private:
  using Known = std::optional<TellPlace>;

  Known known(int corner, int c) const {
    const int lowest = forest_.lowestCorner(corner);
    return lowest < c ? Known(told_[lowest]) : Known();
  }
  /// Of the patch that is glued to `side`.
  Known beyond(int side, int far, int c) const {
    const int other = forest_.glued(side);
    return other == side ? Known() : known(behind(other, far), c);
  }

  TellPlace tell(int c) {
    const Known a = known(behind(c, 1), c), b = known(behind(c, 3), c),
                opposite = known(behind(c, 2), c), beyond_a = beyond(behind(c, 1), 2, c),
                beyond_b = beyond(behind(c, 2), 3, c);
    std::vector<TellPlace> nearby;
    for (const Known& one : {a, b, opposite, beyond_a, beyond_b})
      if (one) nearby.push_back(*one);
    std::vector<Vector> all;
    if (a && b && opposite) all.assign(2, sum(1, sum(1, a->at, 1, b->at), -1, opposite->at));
    if (a && beyond_a) all.push_back(sum(2, a->at, -1, beyond_a->at));
    if (b && beyond_b) all.push_back(sum(2, b->at, -1, beyond_b->at));
    const Vector expected = !all.empty() ? places_.mean(all) : a ? a->at : b ? b->at : latest_;
    const TellPlace told = places_.tell(expected, nearby, static_cast<int>(all.size()));
    latest_ = told.at;
    return told;
  }

  RangeDecoder decoder_;
  PlaceDecoder places_;
  const Forest& forest_;
  std::vector<TellPlace> told_;
  Vector latest_ = {};
};

/// FORMAT 11: the quads, bent by their normals.
class Bent {
 public:
  Bent(const std::vector<Vector>& corners, const Forest& forest)
      : corners_(corners), forest_(forest), n_((int64_t{1} << forest.depth())) {
    std::vector<Vector> sums(corners.size());
    for (int e = 0; e < static_cast<int>(corners.size()); ++e) {
      Vector& at = sums[forest.lowestCorner(e)];
      const auto way = [&](int i) { return sum(1, corners[behind(e, i)], -1, corners[e]); };
      at = sum(1, at, 1, cross(way(3), way(1)));
    }
    for (int c = 0; c < static_cast<int>(corners.size()); ++c)
      normals_.push_back(unit(sums[forest.lowestCorner(c)]));
  }

  BasePoint sample(int c, int64_t x, int64_t y) const {
    const Vector upright = sum(n_ - y, edge(c, c + 1, x), y, edge(c + 3, c + 2, x)),
                 across = sum(n_ - x, edge(c, c + 3, y), x, edge(c + 1, c + 2, y));
    const Vector both = sum(n_, upright, n_, across);
    return {rounded(sum(1, both, -256, mix(corners_, c, x, y)), 2 * forest_.depth()),
            unit(mix(normals_, c, x, y))};
  }

 private:
  Vector mix(const std::vector<Vector>& z, int c, int64_t x, int64_t y) const {
    return sum(n_ - y, sum(n_ - x, z[c], x, z[c + 1]), y, sum(n_ - x, z[c + 3], x, z[c + 2]));
  }
  Vector edge(int a, int b, int64_t k) const {
    if (forest_.lowestCorner(a) > forest_.lowestCorner(b)) return edge(b, a, n_ - k);
    const int64_t r = n_ - k;
    const Vector way = sum(1, corners_[b], -1, corners_[a]);
    const auto tangent = [&](const Vector& normal) {
      return rounded(sum(int64_t{1} << 28, way, -dot(normal, way), normal), 20);
    };
    const Vector straight =
        sum(r * r * (n_ + 2 * k), corners_[a], k * k * (n_ + 2 * r), corners_[b]);
    const Vector bend = sum(k * r * r, tangent(normals_[a]), -k * k * r, tangent(normals_[b]));
    return rounded(sum(256, straight, 1, bend), 3 * forest_.depth());
  }

  const std::vector<Vector>& corners_;
  const Forest& forest_;
  int64_t n_;
  std::vector<Vector> normals_;
};

}  // namespace

std::vector<Vector> readCorners(std::span<const uint8_t> codeword, int bits, const Forest& forest) {
  return Corners(codeword, bits, forest).run();
}

std::vector<BasePoint> bentBase(const std::vector<Vector>& corners, const Forest& forest) {
  const Bent bent(corners, forest);
  const int64_t n = int64_t{1} << forest.depth();
  std::vector<BasePoint> points;
  for (int patch = 0; patch < forest.patches(); ++patch) {
    for (int64_t y = 0; y <= n; ++y)
      for (int64_t x = 0; x <= n; ++x) points.push_back(bent.sample(4 * patch, x, y));
  }
  return points;
}

std::array<double, 3> placeOf(const Object& object, size_t sample, double height) {
  const BasePoint& base = object.points[sample];
  std::array<double, 3> place;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double at = static_cast<double>(base.place[axis]) / 256;
    const double normal = static_cast<double>(base.normal[axis]) / 16384;
    const double along = object.cell * at, above = height * normal;
    place[axis] = object.origin[axis] + along + above;
  }
  return place;
}

}  // namespace tetrakis::reference
