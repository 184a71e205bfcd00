// SPDX-License-Identifier: Apache-2.0
// Normals across seams.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "apps/tools/report/surface_normals.hpp"

namespace tetrakis::tools {
namespace {

using Vector = std::array<double, 3>;

Vector vectorAt(std::span<const double> positions, uint32_t vertex) {
  const size_t first = size_t{3} * vertex;
  return {positions[first], positions[first + 1], positions[first + 2]};
}

/// Of each vertex the first one at its place.
std::vector<uint32_t> firstAtPlace(std::span<const double> positions) {
  std::vector<uint32_t> order(positions.size() / 3);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    const Vector at_a = vectorAt(positions, a), at_b = vectorAt(positions, b);
    return at_a != at_b ? at_a < at_b : a < b;
  });
  std::vector<uint32_t> first(order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool joined = i > 0 && vectorAt(positions, order[i]) == vectorAt(positions, order[i - 1]);
    first[order[i]] = joined ? first[order[i - 1]] : order[i];
  }
  return first;
}

/// Twice the area of the triangle along its normal.
Vector normalOf(const std::array<Vector, 3>& corners) {
  Vector a{}, b{};
  for (size_t k = 0; k < 3; ++k) {
    a[k] = corners[1][k] - corners[0][k];
    b[k] = corners[2][k] - corners[0][k];
  }
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

std::vector<float> joinedNormals(std::span<const double> positions,
                                 std::span<const uint32_t> triangles) {
  const std::vector<uint32_t> first = firstAtPlace(positions);
  std::vector<Vector> sums(first.size());
  for (size_t t = 0; t + 3 <= triangles.size(); t += 3) {
    const Vector normal =
        normalOf({vectorAt(positions, triangles[t]), vectorAt(positions, triangles[t + 1]),
                  vectorAt(positions, triangles[t + 2])});
    for (size_t corner = 0; corner < 3; ++corner)
      for (size_t k = 0; k < 3; ++k) sums[first[triangles[t + corner]]][k] += normal[k];
  }
  std::vector<float> normals;
  normals.reserve(positions.size());
  for (const uint32_t place : first) {
    const Vector& sum = sums[place];
    const double length = std::hypot(sum[0], sum[1], sum[2]);
    const bool known = length > 0 && std::isfinite(length);
    for (size_t k = 0; k < 3; ++k)
      normals.push_back(known ? static_cast<float>(sum[k] / length) : k == 1 ? 1.f : 0.f);
  }
  return normals;
}

}  // namespace tetrakis::tools
