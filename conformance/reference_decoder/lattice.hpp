// SPDX-License-Identifier: Apache-2.0
// Reference decoder: the 4-8 lattice as bands, and the neighbours of its vertices (docs/FORMAT.md,
// section 7).
#pragma once

#include <cstdint>
#include <vector>

#include "conformance/reference_decoder/track.hpp"

namespace tetrakis::reference {

enum Shape { kRoots, kCentres, kMidpoints };

/// One band of the lattice: which vertices of the grid its coefficients belong to.
struct LatticeBand {
  Shape shape;
  int step;  ///< s; for roots 2^d

  int x(int r, int a) const {
    if (shape == kRoots) return step * a;
    return shape == kMidpoints && r % 2 == 1 ? 2 * step * a : step * (2 * a + 1);
  }
  int y(int r) const { return shape == kCentres ? step * (2 * r + 1) : step * r; }
};

/// The bands of a track, each with its place on the lattice.
struct Lattice {
  std::vector<LatticeBand> places;
  std::vector<Band> bands;
};

struct Tap {
  int dx, dy, weight;
};

/// FORMAT 7: "24 neighbours and weights", as offsets on the grid.
inline std::vector<Tap> tapsOf(const LatticeBand& band) {
  constexpr Tap kQuarter[] = {{1, 0, 174}, {2, 1, -27}, {1, 2, -27},
                              {3, 0, 2},   {3, 2, 3},   {2, 3, 3}};
  std::vector<Tap> taps;
  for (Tap tap : kQuarter) {
    if (band.shape == kCentres) tap = {tap.dx - tap.dy, tap.dx + tap.dy, tap.weight};
    for (int turn = 0; turn < 4; ++turn) {
      taps.push_back({band.step * tap.dx, band.step * tap.dy, tap.weight});
      tap = {-tap.dy, tap.dx, tap.weight};
    }
  }
  return taps;
}

struct Grid {
  int width, height;
  std::vector<int32_t> values;

  std::vector<uint8_t> valid = {};  ///< empty: all are

  int32_t& at(int x, int y) { return values[static_cast<size_t>(y) * width + x]; }
  bool isValid(int x, int y) const {
    return valid.empty() || valid[static_cast<size_t>(y) * width + x];
  }
};

/// FORMAT 7, "Boundary", on one axis: mirrors `offset` if it leads outside; false: left out.
inline bool mirror(int position, int size, int& offset) {
  const auto inside = [&](int o) { return position + o >= 0 && position + o < size; };
  if (!inside(offset)) offset = -offset;
  return inside(offset);
}

}  // namespace tetrakis::reference
