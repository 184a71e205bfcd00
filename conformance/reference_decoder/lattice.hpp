// SPDX-License-Identifier: Apache-2.0
// Reference decoder: the 4-8 lattice (docs/FORMAT.md, section 8.1.1).
#pragma once

#include <algorithm>

namespace tetrakis::reference {

struct Offset {
  int x, y;
};

/// A vertex of the level s; s = 0: a root.
struct Vertex {
  bool centre;
  int s, x, y;

  /// The i-th of the "12 coarser neighbours".
  Offset coarser(int i) const {
    constexpr Offset kFirst[] = {{1, 0}, {2, 1}, {1, 2}};
    Offset o = kFirst[i / 4];
    for (int turn = 0; turn < i % 4; ++turn) o = {-o.y, o.x};
    if (centre) o = {o.x - o.y, o.x + o.y};
    return {s * o.x, s * o.y};
  }
  Offset c1() const { return centre ? Offset{-2 * s, 0} : Offset{-s, -s}; }
  Offset c2() const { return centre ? Offset{0, -2 * s} : Offset{s, -s}; }
};

/// In the order of the levels. root: how far roots lie apart.
template <class Visit>
void forEachVertex(int width, int height, int root, const Visit& visit) {
  for (int y = 0; y < height; y += root) {
    for (int x = 0; x < width; x += root) visit(Vertex{false, 0, x, y});
  }
  for (int s = root / 2; s >= 1; s /= 2) {
    for (int y = s; y < height; y += 2 * s) {
      for (int x = s; x < width; x += 2 * s) visit(Vertex{true, s, x, y});
    }
    for (int y = 0; y < height; y += s) {
      for (int x = y / s % 2 == 0 ? s : 0; x < width; x += 2 * s) visit(Vertex{false, s, x, y});
    }
  }
}

/// The same, with as few roots as there can be.
template <class Visit>
void forEachVertex(int width, int height, const Visit& visit) {
  int root = 1;
  while (root < std::max(width, height) - 1) root *= 2;
  forEachVertex(width, height, root, visit);
}

}  // namespace tetrakis::reference
