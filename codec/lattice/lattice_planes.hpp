// SPDX-License-Identifier: Apache-2.0
// LatticePlanes holds one bit for each vertex of the 4-8 lattice that is known so far, at multiples
// of one step. The bits lie in four planes of half as many columns and rows: those of the corners
// of squares, of their centres, and of the midpoints of horizontal and of vertical edges. So the
// neighbours of 64 vertices in a row, in one direction, are 64 bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/bit_plane.hpp"

namespace tetrakis::inline lattice {

/// Whether the column (x) and the row (y) of a vertex are odd (1) or even (0), in steps.
struct Parity {
  uint32_t x, y;

  size_t index() const { return x + 2 * y; }
};

/// Where the neighbour of a vertex lies, in one direction.
struct PlaneTap {
  size_t plane = 0;    ///< Parity::index()
  int dx = 0, dy = 0;  ///< from the vertex's place in its own plane

  PlaneTap() = default;
  /// offset_x, offset_y: from the vertex, in steps.
  PlaneTap(Parity vertex, int offset_x, int offset_y) {
    const int x = static_cast<int>(vertex.x) + offset_x, y = static_cast<int>(vertex.y) + offset_y;
    plane = Parity{x & 1u, y & 1u}.index();
    dx = x >> 1;
    dy = y >> 1;
  }
};

class LatticePlanes {
 public:
  /// corners: the marks of the lattice of twice the step. size: columns and rows of this lattice.
  LatticePlanes(BitPlane corners, Extent size) : size_(size) {
    for (size_t i = 1; i < planes_.size(); ++i) planes_[i] = BitPlane(corners.extent());
    planes_[0] = std::move(corners);
  }

  Extent size() const { return size_; }
  BitPlane& of(Parity parity) { return planes_[parity.index()]; }
  bool at(uint32_t x, uint32_t y) const {
    return planes_[Parity{x & 1, y & 1}.index()].at(x / 2, y / 2);
  }
  /// The neighbours of 64 vertices: those of word k of row y of their plane.
  uint64_t word(const PlaneTap& tap, uint32_t y, uint32_t k) const {
    const auto row = static_cast<uint32_t>(static_cast<int>(y) + tap.dy);
    const uint64_t* const at = planes_[tap.plane].row(row) + k;
    if (tap.dx == 0) return *at;
    if (tap.dx < 0) return *at << 1 | *(at - 1) >> (kWordBits - 1);
    return *at >> tap.dx | *(at + 1) << (kWordBits - static_cast<uint32_t>(tap.dx));
  }

  /// The marks of all vertices, row by row.
  BitPlane joined() const {
    BitPlane all(size_);
    for (uint32_t y = 0; y < size_.height; ++y) {
      const uint64_t* const even = planes_[Parity{0, y & 1}.index()].row(y / 2);
      const uint64_t* const odd = planes_[Parity{1, y & 1}.index()].row(y / 2);
      for (uint32_t k = 0; k < all.words(); ++k) {
        const uint32_t half = k % 2 * (kWordBits / 2);
        all.row(y)[k] = apart(even[k / 2] >> half) | apart(odd[k / 2] >> half) << 1;
      }
    }
    return all;
  }

 private:
  /// The 32 lowest bits, each before a 0.
  static uint64_t apart(uint64_t bits) {
    bits &= 0xffffffff;
    bits = (bits | bits << 16) & 0x0000ffff0000ffff;
    bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
    bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
    bits = (bits | bits << 2) & 0x3333333333333333;
    return (bits | bits << 1) & 0x5555555555555555;
  }

  Extent size_;
  std::array<BitPlane, 4> planes_;
};

}  // namespace tetrakis::inline lattice
