// SPDX-License-Identifier: Apache-2.0
// Reference decoder: a band, its neighbourhoods and the values of its coefficients (docs/FORMAT.md,
// sections 5 and 6).
#include <algorithm>
#include <cstdlib>

#include "conformance/reference_decoder/activity.hpp"
#include "conformance/reference_decoder/track.hpp"

namespace tetrakis::reference {
namespace {

/// FORMAT 6, table C.
constexpr uint64_t kCentroids[] = {16, 19, 20, 22, 23, 25, 27, 28, 29, 30, 30};

/// FORMAT 6, table A, B, D.
struct SignWeights {
  int along, across, far;
};

SignWeights weightsOf(Orientation orientation) {
  if (orientation == kLL) return {0, 0, 0};
  return orientation == kHH ? SignWeights{-3, -3, 1} : SignWeights{-8, 3, -1};
}

/// sixtyfourths / 64 * (2^plane - 1) * 2^e, rounded down.
int64_t fraction(uint64_t sixtyfourths, int plane, int e) {
  const uint64_t interval = (uint64_t{1} << plane) - 1;
  return static_cast<int64_t>((sixtyfourths * (interval << e)) >> 6);
}

}  // namespace

Band::Band(int rowCount, int columnCount, Orientation direction)
    : rows(rowCount), columns(columnCount), orientation(direction) {
  coefficients.resize(size_t(rows) * size_t(columns));
  blocks.resize(size_t(blockRows()) * size_t(blockColumns()));
}

bool Band::empty() const {
  return std::all_of(coefficients.begin(), coefficients.end(),
                     [](const Coefficient& c) { return c.absent; });
}

uint32_t Band::existing(int priority) const {
  return static_cast<uint32_t>(
      std::count_if(coefficients.begin(), coefficients.end(),
                    [&](const Coefficient& c) { return !c.absent && c.priority == priority; }));
}

Coefficient& Band::at(int r, int a) {
  return coefficients.at(size_t(r) * columns + a);
}

Coefficient Band::get(int r, int a) const {
  if (r < 0 || r >= rows || a < 0 || a >= columns) return {};
  return coefficients.at(size_t(r) * columns + a);
}

Neighbours Band::neighboursOf(int r, int a) const {
  const Coefficient left = get(r, a - 1), right = get(r, a + 1);
  const Coefficient above = get(r - 1, a), below = get(r + 1, a);
  Neighbours n{{left, right},
               {above, below},
               {get(r - 1, a - 1), get(r - 1, a + 1), get(r + 1, a - 1), get(r + 1, a + 1)}};
  if (orientation == kLH) std::swap(n.along, n.across);
  return n;
}

bool Band::blockMarked(int row, int column) const {
  if (row < 0 || row >= blockRows() || column < 0 || column >= blockColumns()) return false;
  const auto& of = blocks.at(size_t(row) * blockColumns() + column);
  return std::find(of.begin(), of.end(), true) != of.end();
}

int32_t Band::value(int r, int a, int e) const {
  const Coefficient c = get(r, a);
  const Neighbours n = neighboursOf(r, a);
  if (c.magnitude > 0) {
    int64_t size = int64_t{c.magnitude} << e;
    if (c.plane > 0) size += fraction(kCentroids[activity(n, c.plane)], c.plane, e);
    return static_cast<int32_t>(c.sign * size);
  }
  if (c.plane == 0) return 0;
  const SignWeights w = weightsOf(orientation);
  const auto signOf = [&](const Coefficient& neighbour) {
    return (2 * uint64_t{neighbour.magnitude}) >> c.plane > 0 ? neighbour.sign : 0;
  };
  int t = w.along * (signOf(n.along[0]) + signOf(n.along[1])) +
          w.across * (signOf(n.across[0]) + signOf(n.across[1]));
  for (const Coefficient& far : n.far) t += w.far * signOf(far);
  const int64_t size = fraction(static_cast<uint64_t>(std::abs(t)), c.plane, e);
  return static_cast<int32_t>(t < 0 ? -size : size);
}

}  // namespace tetrakis::reference
