// SPDX-License-Identifier: Apache-2.0
#include "codec/trianglemesh/flat_triangle.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "bitstream/coder/place_coder.hpp"

namespace tetrakis::inline trianglemesh {
namespace {

using Edge = std::array<int64_t, 3>;

int64_t product(const Edge& a, const Edge& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The largest whole number whose square is no more. square: below 2^62.
int64_t floorRoot(int64_t square) {
  int64_t root = 0;
  for (int64_t bit = int64_t{1} << 30; bit > 0; bit >>= 1)
    if ((root + bit) * (root + bit) <= square) root += bit;
  return root;
}

/// From the first place to the others, in units of a power of two in which all numbers are up to
/// 2^14: then products of four of them can be summed. Halves are rounded up.
std::array<Edge, 2> edgesOf(const std::array<Place, 3>& places) {
  constexpr int kBits = 14;
  std::array<Edge, 2> edges;
  uint64_t bits = 0;
  for (size_t end = 0; end < 2; ++end) {
    for (size_t axis = 0; axis < 3; ++axis) {
      edges[end][axis] = int64_t{places[end + 1][axis]} - places[0][axis];
      bits |= static_cast<uint64_t>(std::abs(edges[end][axis]));
    }
  }
  const int shift = static_cast<int>(std::bit_width(bits)) - kBits;
  if (shift <= 0) return edges;
  for (Edge& edge : edges)
    for (int64_t& value : edge) value = (value + (int64_t{1} << (shift - 1))) >> shift;
  return edges;
}

}  // namespace

Texcoord flatCorner(const std::array<Place, 3>& places, const std::array<Texcoord, 2>& flat,
                    bool is_mirrored) {
  const auto [base, side] = edgesOf(places);
  const int64_t square = product(base, base), along = product(base, side);
  if (square == 0) return flat[0];
  // The square of the cross product of both.
  const int64_t height = floorRoot(square * product(side, side) - along * along);
  const int64_t up = is_mirrored ? -height : height;
  const int64_t dx = int64_t{flat[1][0]} - flat[0][0], dy = int64_t{flat[1][1]} - flat[0][1];
  const auto moved = [&](size_t axis, int64_t sum) {
    constexpr int64_t kMost = 1 << 30;  // the triangle may be far longer than its first side
    const int64_t by = std::clamp(roundedMean(sum, square), -kMost, kMost);
    return static_cast<int32_t>(flat[0][axis] + by);
  };
  return {moved(0, along * dx - up * dy), moved(1, along * dy + up * dx)};
}

}  // namespace tetrakis::inline trianglemesh
