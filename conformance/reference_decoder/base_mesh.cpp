// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/base_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <optional>

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
      : decoder_(codeword), forest_(forest), bits_(bits), places_(size_t(4) * forest.patches()) {}

  std::vector<Vector> run() {
    for (int c = 0; c < static_cast<int>(places_.size()); ++c) {
      const int lowest = forest_.lowestCorner(c);
      places_[c] = lowest < c ? places_[lowest] : told(c);
    }
    return places_;
  }

 private:
  using Known = std::optional<Vector>;

  Vector told(int c) {
    const int64_t size = int64_t{1} << bits_;
    latest_ = expected(c);
    for (size_t axis = 0; axis < 3; ++axis)
      latest_[axis] = (latest_[axis] + difference(axis) + size) % size;
    return latest_;
  }

  Known known(int corner, int c) const {
    const int lowest = forest_.lowestCorner(corner);
    return lowest < c ? Known(places_[lowest]) : Known();
  }
  /// Twice the corner `near` less one of the patch that is glued to `side`.
  Known continued(int c, int near, int side, int far) const {
    const int other = forest_.glued(side);
    if (other == side) return {};
    const Known from = known(near, c), before = known(behind(other, far), c);
    if (!from || !before) return {};
    return sum(2, *from, -1, *before);
  }

  Vector expected(int c) const {
    const int c1 = behind(c, 1), c2 = behind(c, 2), c3 = behind(c, 3);
    const Known a = known(c1, c), b = known(c3, c), opposite = known(c2, c);
    std::vector<Vector> all;
    if (a && b && opposite) all.assign(2, sum(1, sum(1, *a, 1, *b), -1, *opposite));
    for (const Known& one : {continued(c, c1, c1, 2), continued(c, c3, c2, 3)})
      if (one) all.push_back(*one);
    if (all.empty()) return a ? *a : b ? *b : latest_;
    Vector total = {};
    for (const Vector& one : all) total = sum(1, total, 1, one);
    const auto count = static_cast<int64_t>(all.size()), most = (int64_t{1} << bits_) - 1;
    for (int64_t& value : total)
      value = std::clamp<int64_t>(floorDiv(2 * value + count, 2 * count), 0, most);
    return total;
  }

  int64_t difference(size_t axis) {
    Model* more =
        more_[std::min((latest_bits_[0] + latest_bits_[1] + latest_bits_[2] + 1) / 3, 15)];
    const int k = ones(bits_, [&](int i) { return ask(&more[i]); });
    latest_bits_[axis] = k;
    if (k == 0) return 0;
    const int64_t d =
        digits(k, [&](int, uint32_t v) { return ask(v < 4 ? &high_[k][v] : nullptr); });
    return ask(nullptr) ? -d : d;
  }
  /// A decision of a model, or an even one; 0 from the first one on that does not count.
  int ask(Model* model) {
    if (ended_) return 0;
    try {
      return model == nullptr ? decoder_.even() : model->decode(decoder_);
    } catch (const Undecided&) {
      ended_ = true;
      return 0;
    }
  }

  RangeDecoder decoder_;
  const Forest& forest_;
  int bits_;
  std::vector<Vector> places_;
  Vector latest_ = {};
  std::array<int, 3> latest_bits_ = {};
  Model more_[16][20], high_[21][4];
  bool ended_ = false;
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
