// SPDX-License-Identifier: Apache-2.0
// RowSurroundings takes the vertices of the lattice that are known so far, which LatticePlanes
// keeps as planes of bits, and returns the known neighbours of 64 vertices in a row at once,
// because masks have wide areas in which all neighbours are alike.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/bit_plane.hpp"
#include "codec/lattice/levels.hpp"

namespace tetrakis::inline lattice {

// LatticePlanes holds one bit for each vertex of the 4-8 lattice that is known so far, at multiples
// of one step. The bits lie in four planes of half as many columns and rows: those of the corners
// of squares, of their centres, and of the midpoints of horizontal and of vertical edges. So the
// neighbours of 64 vertices in a row, in one direction, are 64 bits.

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

// RowSurroundings collects the known neighbours of 64 vertices in a row, one bit for each vertex
// and direction. The contexts of masks (codec/lattice/validity.hpp) are made of these bits.

/// The neighbours of all vertices of one parity: where they lie, and where their marks are.
struct RowKind {
  static constexpr size_t kNear = Stencil::kRingSize[0], kCausal = 2, kRing = Stencil::kRingSize[1],
                          kTaps = kNear + kCausal + kRing;

  Parity parity;
  uint32_t reach;
  std::array<int, kTaps> dx{}, dy{};  ///< of near, causal and ring, in steps
  std::array<PlaneTap, kTaps> taps{};

  explicit RowKind(Parity of) : parity(of) {
    const bool centre = of.x == 1 && of.y == 1;
    const Stencil stencil = stencilOf(centre ? LevelKind::kCentres : LevelKind::kMidpoints, 1, 0);
    reach = static_cast<uint32_t>(stencil.reach);
    size_t count = 0;
    const auto add = [&](int x, int y) {
      dx[count] = x;
      dy[count] = y;
      taps[count++] = PlaneTap(of, x, y);
    };
    for (size_t i = 0; i < kNear; ++i) add(stencil.dx[i], stencil.dy[i]);
    centre ? add(-2, 0) : add(-1, -1);
    centre ? add(0, -2) : add(1, -1);
    for (size_t i = kNear; i < Stencil::kTaps; ++i) add(stencil.dx[i], stencil.dy[i]);
  }
};

/// The neighbours of one vertex, as the contexts of masks count them.
struct Around {
  unsigned near = 0, causal = 0;  ///< a bit for each neighbour: 1 is valid
  unsigned ring = 0;              ///< how many neighbours of the ring are valid
  bool majority = true;           ///< whether most of the near neighbours are valid
};

class RowSurroundings {
 public:
  /// Of the vertices of word `word` of a row of the lattice.
  RowSurroundings(const LatticePlanes& planes, const RowKind& kind, uint32_t y, uint32_t word)
      : planes_(planes), kind_(kind), y_(y), word_(word) {
    const Extent size = planes.size();
    if (y < kind.reach || y + kind.reach >= size.height || size.width <= 2 * kind.reach) return;
    const uint32_t first = (kind.reach - kind.parity.x + 1) / 2;
    const uint32_t end = (size.width - kind.reach - kind.parity.x + 1) / 2;
    inside_ = bitsBefore(end) & ~bitsBefore(first);
    for (size_t i = 0; i < RowKind::kTaps; ++i) around_[i] = planes.word(kind.taps[i], y / 2, word);
    findAlike();
  }

  /// Those all of whose neighbours lie in the grid.
  uint64_t inside() const { return inside_; }
  /// Of these, those all of whose neighbours are marked, or none; the vertex before in the row may
  /// be one that is not known yet.
  uint64_t alike(bool marked) const { return marked ? all_ : none_; }
  /// What most of the near neighbours are of those inside; of as many of both, 1.
  uint64_t majority() const {
    const uint64_t a = around_[0], b = around_[1], c = around_[2], d = around_[3];
    return (a & b) | (c & d) | ((a | b) & (c | d));
  }
  /// The first causal neighbour of a vertex; of one at the border, whatever.
  bool before(uint32_t i) const {
    if ((inside_ >> i & 1) == 0) return false;
    return planes_.word(kind_.taps[RowKind::kNear], y_ / 2, word_) >> i & 1;
  }

  Around at(uint32_t i) const { return inside_ >> i & 1 ? inside(i) : atBorder(i); }

 private:
  /// The bits of the word that lie before a column of the plane.
  uint64_t bitsBefore(uint32_t column) const {
    const uint32_t start = word_ * kWordBits;
    return column > start ? lowBits(column - start) : 0;
  }

  void findAlike() {
    uint64_t any = 0;
    all_ = ~uint64_t{0};
    for (size_t i = 0; i < RowKind::kTaps; ++i) {
      if (kind_.dy[i] == 0 && i == RowKind::kNear) continue;  // before() in the same row
      all_ &= around_[i];
      any |= around_[i];
    }
    all_ &= inside_;
    none_ = inside_ & ~any;
  }

  Around inside(uint32_t i) const {
    Around around;
    unsigned count = 0;
    for (size_t tap = 0; tap < RowKind::kNear; ++tap) {
      const auto bit = static_cast<unsigned>(around_[tap] >> i & 1);
      around.near |= bit << tap;
      count += bit;
    }
    for (size_t tap = RowKind::kNear + RowKind::kCausal; tap < RowKind::kTaps; ++tap)
      around.ring += static_cast<unsigned>(around_[tap] >> i & 1);
    around.causal = 2u * before(i) + static_cast<unsigned>(around_[RowKind::kNear + 1] >> i & 1);
    around.majority = 2 * count >= RowKind::kNear;
    return around;
  }

  /// Neighbours outside the grid are mirrored as in lifting. Where the mirror image is outside as
  /// well, the neighbour counts as void; a causal one that is outside, as what most of near are.
  Around atBorder(uint32_t i) const {
    const Extent size = planes_.size();
    const uint32_t x = 2 * (word_ * kWordBits + i) + kind_.parity.x;
    Around around;
    unsigned count = 0, there = 0;
    for (size_t tap = 0; tap < RowKind::kTaps; ++tap) {
      if (tap == RowKind::kNear) tap += RowKind::kCausal;
      const int64_t nx = mirrored(x, kind_.dx[tap], size.width);
      const int64_t ny = mirrored(y_, kind_.dy[tap], size.height);
      if (nx < 0 || ny < 0) continue;
      const unsigned bit = planes_.at(static_cast<uint32_t>(nx), static_cast<uint32_t>(ny));
      if (tap > RowKind::kNear) {
        around.ring += bit;
      } else {
        around.near |= bit << tap;
        count += bit;
        ++there;
      }
    }
    around.majority = 2 * count >= there;
    around.causal = 2 * causal(x, 0, around.majority) + causal(x, 1, around.majority);
    return around;
  }

  unsigned causal(uint32_t x, size_t which, bool otherwise) const {
    const int64_t nx = int64_t{x} + kind_.dx[RowKind::kNear + which];
    const int64_t ny = int64_t{y_} + kind_.dy[RowKind::kNear + which];
    if (nx < 0 || ny < 0 || nx >= planes_.size().width) return otherwise;
    return planes_.at(static_cast<uint32_t>(nx), static_cast<uint32_t>(ny));
  }

  const LatticePlanes& planes_;
  const RowKind& kind_;
  uint32_t y_, word_;
  uint64_t inside_ = 0, all_ = 0, none_ = 0;
  std::array<uint64_t, RowKind::kTaps> around_{};
};

}  // namespace tetrakis::inline lattice
