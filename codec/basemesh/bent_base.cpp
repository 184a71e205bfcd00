// SPDX-License-Identifier: Apache-2.0
#include "codec/basemesh/bent_base.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>

namespace tetrakis::inline basemesh {

namespace {

Vector operator+(const Vector& a, const Vector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector operator-(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector operator*(int64_t s, const Vector& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
int64_t dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// a / 2^bits, halves rounded up.
int64_t shifted(int64_t a, int bits) {
  return bits == 0 ? a : (a + (int64_t{1} << (bits - 1))) >> bits;
}
Vector shifted(const Vector& a, int bits) {
  return {shifted(a[0], bits), shifted(a[1], bits), shifted(a[2], bits)};
}

/// The largest integer whose square is no more than x, which is below 2^63. The root of a double is
/// off by less than 1.
uint64_t rootOf(uint64_t x) {
  auto root = static_cast<uint64_t>(std::sqrt(static_cast<double>(x)));
  while (root * root > x) --root;
  while ((root + 1) * (root + 1) <= x) ++root;
  return root;
}

/// The largest integer that is no more than a / b, of |a| below 2^53 and b from 1 to 2^53. The
/// quotient of doubles, which is found much sooner, is off by less than 1 before it is cut.
int64_t quotientOf(int64_t a, int64_t b) {
  auto quotient = static_cast<int64_t>(static_cast<double>(a) / static_cast<double>(b));
  while (quotient * b > a) --quotient;
  while ((quotient + 1) * b <= a) ++quotient;
  return quotient;
}

/// The same direction, 2^kNormalBits long; 0 for 0.
Vector unit(Vector a) {
  constexpr int kBits = 30;  // whose squares fit in 64 bits, all three together
  const int64_t largest = std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
  if (largest == 0) return {};
  const int bits = static_cast<int>(std::bit_width(static_cast<uint64_t>(largest)));
  for (int64_t& value : a)
    value = bits > kBits ? shifted(value, bits - kBits) : value * (int64_t{1} << (kBits - bits));
  const auto length = static_cast<int64_t>(rootOf(static_cast<uint64_t>(dot(a, a))));
  for (int64_t& value : a)
    value = quotientOf(value * (int64_t{2} << BentBase::kNormalBits) + length, 2 * length);
  return a;
}

Vector wide(const Cell& cell) {
  return {cell[0], cell[1], cell[2]};
}

}  // namespace

BentBase::BentBase(const BaseMesh& mesh)
    : mesh_(mesh), n_(mesh.forest->side() - 1), owners_(cornerOwners(*mesh.forest)) {
  assert(mesh.forest->depth() <= BaseMeshHeader::kMostDepth);
  normals_.resize(owners_.size());
  for (uint32_t corner = 0; corner < owners_.size(); ++corner) {
    const uint32_t first = corner - corner % Forest::kSides;
    const auto place = [&](uint32_t steps) {
      return wide(mesh.corners[first + (corner + steps) % Forest::kSides]);
    };
    // Corners go clockwise on a raster whose y points down: seen from outside, counterclockwise
    // once y points up.
    Vector& sum = normals_[owners_[corner]];
    sum = sum + cross(place(3) - place(0), place(1) - place(0));
  }
  for (uint32_t corner = 0; corner < owners_.size(); ++corner) {
    const uint32_t owner = owners_[corner];
    normals_[corner] = owner == corner ? unit(normals_[corner]) : normals_[owner];
  }
}

Vector BentBase::edgePoint(uint32_t from, uint32_t to, int64_t k) const {
  if (owners_[from] > owners_[to]) return edgePoint(to, from, n_ - k);
  const Vector a = wide(mesh_.corners[from]), b = wide(mesh_.corners[to]), chord = b - a;
  // The chord less its part along the normal, in places.
  const auto tangent = [&](const Vector& normal) {
    return shifted((int64_t{1} << (2 * kNormalBits)) * chord - dot(normal, chord) * normal,
                   2 * kNormalBits - kPlaceBits);
  };
  // Hermite's polynomials of k / n, times n^3.
  const int64_t n = n_, r = n - k;
  const int64_t begin = r * r * (n + 2 * k), end = k * k * (n + 2 * r);
  const Vector sum = (begin << kPlaceBits) * a + (end << kPlaceBits) * b +
                     (k * r * r) * tangent(normals_[from]) - (k * k * r) * tangent(normals_[to]);
  return shifted(sum, 3 * mesh_.forest->depth());
}

std::vector<BasePoint> BentBase::patch(uint32_t patch) const {
  const uint32_t first = patch * Forest::kSides;
  const int64_t n = n_;
  std::vector<Vector> north, east, south, west;
  for (int64_t k = 0; k <= n; ++k) {
    north.push_back(edgePoint(first, first + 1, k));
    east.push_back(edgePoint(first + 1, first + 2, k));
    south.push_back(edgePoint(first + 3, first + 2, k));
    west.push_back(edgePoint(first, first + 3, k));
  }
  std::vector<BasePoint> points;
  points.reserve(static_cast<size_t>((n + 1) * (n + 1)));
  // Coons' patch less its bilinear part, all times n^2, is linear along a row but for two edges.
  const auto mixed = [n](int64_t k, const Vector& begin, const Vector& end) {
    return (n - k) * begin + k * end;
  };
  const Vector* const normals = &normals_[first];
  const int bits = 2 * mesh_.forest->depth();
  for (int64_t j = 0; j <= n; ++j) {
    const auto y = static_cast<size_t>(j);
    const Vector begin = n * west[y] - mixed(j, north.front(), south.front());
    const Vector end = n * east[y] - mixed(j, north.back(), south.back());
    const Vector first_normal = mixed(j, normals[0], normals[3]);
    const Vector last_normal = mixed(j, normals[1], normals[2]);
    for (int64_t i = 0; i <= n; ++i) {
      const auto x = static_cast<size_t>(i);
      const Vector place = n * mixed(j, north[x], south[x]) + mixed(i, begin, end);
      points.push_back({shifted(place, bits), unit(mixed(i, first_normal, last_normal))});
    }
  }
  return points;
}

std::array<double, 3> placeOf(const BaseMesh& mesh, const BasePoint& base, double height) {
  constexpr double kPlace = 1.0 / (1 << BentBase::kPlaceBits);
  constexpr double kNormal = 1.0 / (1 << BentBase::kNormalBits);
  std::array<double, 3> place;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double at = static_cast<double>(base.place[axis]) * kPlace;
    const double normal = static_cast<double>(base.normal[axis]) * kNormal;
    place[axis] = mesh.origin[axis] + mesh.cell * at + height * normal;
  }
  return place;
}

}  // namespace tetrakis::inline basemesh
