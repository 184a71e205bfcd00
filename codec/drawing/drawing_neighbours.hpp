// SPDX-License-Identifier: Apache-2.0
// Candidates takes a vertex of a drawing and returns the values of its known neighbours, the
// likeliest first. A value is known by its DrawnIndex in the list of the drawing's values, which
// both sides build.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/plane.hpp"
#include "codec/lattice/levels.hpp"

namespace tetrakis::inline drawing {

// A drawing has a list of the values of its vertices (colours, or heights in steps), in the order
// in which they first appear. Encoder and decoder both build it; a vertex has the index of its
// value.

/// Place of a value in the list; the vertices that nothing is known of have kNoIndex.
using DrawnIndex = uint16_t;

inline constexpr int kDrawnIndexBits = 12;
inline constexpr size_t kMostDrawnValues = size_t{1} << kDrawnIndexBits;
inline constexpr DrawnIndex kNoIndex = 0xffff;

/// An index as planes keep it: kNoIndex where nothing was written to zeroed memory, which then need
/// not even be there.
class KeptIndex {
 public:
  KeptIndex() = default;
  KeptIndex& operator=(DrawnIndex index) {
    complement_ = static_cast<DrawnIndex>(~index);
    return *this;
  }
  operator DrawnIndex() const { return static_cast<DrawnIndex>(~complement_); }

 private:
  DrawnIndex complement_;
};

// Candidates ranks the values of the known neighbours of a vertex by their votes, because a drawing
// asks for the likeliest value first.
//
//   near     the 4 coarser vertices next to it: diagonal ones for a centre, along the axes for a
//            midpoint; 6 votes each
//   causal   2 vertices of its own level that came before: (-2s, 0) and (0, -2s) for a centre,
//            (-s, -s) and (s, -s) for a midpoint; 4 votes each
//   ring     the 8 coarser vertices at sqrt 5 times the distance of near; 1 vote each

/// A value among the neighbours.
struct VotedIndex {
  DrawnIndex index;
  uint16_t pattern;            ///< of the neighbours that have it, in the order above, bit 0 first
  uint8_t near, causal, ring;  ///< how many of them
  uint8_t votes;
};

/// The candidates around one vertex: the first three by votes, of equal ones the first met.
class Candidates {
 public:
  static constexpr int kRanked = 3;
  static constexpr int kNear = Stencil::kRingSize[0], kCausal = 2, kRing = Stencil::kRingSize[1];
  static constexpr int kNeighbours = kNear + kCausal + kRing;
  using Indices = std::array<DrawnIndex, kNeighbours>;

  /// known: the bits of the neighbours that there are.
  Candidates(const Indices& indices, uint32_t known) : neighbours_(indices), known_(known) {
    while (known != 0) {
      const DrawnIndex index = indices[static_cast<size_t>(std::countr_zero(known))];
      uint32_t pattern = 0;
      for (int i = 0; i < kNeighbours; ++i)
        pattern |= uint32_t{indices[static_cast<size_t>(i)] == index} << i;
      add(index, pattern & known);
      known &= ~pattern;
    }
    rank();
  }

  /// All neighbours have one value, whichever.
  static Candidates unanimous() { return Candidates(Indices{}, (1u << kNeighbours) - 1); }

  int count() const { return count_; }
  const VotedIndex& operator[](int place) const { return all_[static_cast<size_t>(place)]; }
  /// kNoIndex beyond the last one.
  DrawnIndex at(int place) const { return place < count_ ? (*this)[place].index : kNoIndex; }
  /// The index of a neighbour, in the order above; kNoIndex if there is none.
  DrawnIndex neighbour(size_t i) const { return known_ >> i & 1 ? neighbours_[i] : kNoIndex; }

 private:
  void add(DrawnIndex index, uint32_t pattern) {
    const uint8_t near = bitsOf(pattern & 0xf), causal = bitsOf(pattern >> 4 & 3),
                  ring = static_cast<uint8_t>(bitsOf(pattern >> 6 & 0xf) + bitsOf(pattern >> 10));
    all_[static_cast<size_t>(count_++)] = {
        index, static_cast<uint16_t>(pattern),
        near,  causal,
        ring,  static_cast<uint8_t>(6 * near + 4 * causal + ring)};
  }

  /// Ones among four bits, where processors may lack an instruction for that.
  static uint8_t bitsOf(uint32_t four) {
    constexpr uint64_t kCounts = 0x4332322132212110;
    return kCounts >> (4 * four) & 0xf;
  }

  void rank() {
    for (int place = 0; place < std::min(kRanked, count_ - 1); ++place) {
      const auto first = all_.begin() + place;
      const auto best = std::max_element(
          first, all_.begin() + count_,
          [](const VotedIndex& a, const VotedIndex& b) { return a.votes < b.votes; });
      std::rotate(first, best, best + 1);
    }
  }

  Indices neighbours_;
  uint32_t known_;
  std::array<VotedIndex, kNeighbours> all_;  // only the first count_ are written
  int count_ = 0;
};

/// Looks around the vertices of one level. indices: width * height, row by row. Vertices without
/// one, as voids, are no neighbours.
class Neighbourhood {
 public:
  Neighbourhood(const Level& level, std::span<const KeptIndex> indices, Extent extent)
      : indices_(indices.data()), width_(extent.width), height_(extent.height) {
    if (level.kind == LevelKind::kRoots) return;
    const Stencil stencil = stencilOf(level.kind, level.step, width_);
    const int s = static_cast<int>(level.step);
    const bool centre = level.kind == LevelKind::kCentres;
    for (int tap = 0; tap < Candidates::kNear; ++tap) add(stencil.dx[tap], stencil.dy[tap]);
    add(centre ? -2 * s : -s, centre ? 0 : -s);
    add(centre ? 0 : s, centre ? -2 * s : -s);
    for (int tap = Candidates::kNear; tap < Stencil::kTaps; ++tap)
      add(stencil.dx[tap], stencil.dy[tap]);
    reach_ = static_cast<uint32_t>(stencil.reach);
  }

  /// The index that all neighbours have; kNoIndex if they differ or some lie outside.
  DrawnIndex common(uint32_t x, uint32_t y) const {
    if (count_ == 0 || !inside(x, y)) return kNoIndex;
    const KeptIndex* const at = indices_ + size_t{y} * width_ + x;
    const DrawnIndex first = at[neighbours_[0].linear];
    uint32_t differences = 0;
    for (const Neighbour& n : neighbours_)
      differences |= static_cast<uint32_t>(DrawnIndex{at[n.linear]} ^ first);
    return differences == 0 ? first : kNoIndex;
  }

  Candidates around(uint32_t x, uint32_t y) const {
    const KeptIndex* const at = indices_ + size_t{y} * width_ + x;
    const bool all = inside(x, y);
    Candidates::Indices indices{};
    uint32_t known = 0;
    for (int i = 0; i < count_; ++i) {
      const Neighbour& n = neighbours_[static_cast<size_t>(i)];
      if (!all && !(reaches(x, n.dx, width_) && reaches(y, n.dy, height_))) continue;
      const DrawnIndex index = at[n.linear];
      indices[static_cast<size_t>(i)] = index;
      known |= uint32_t{index != kNoIndex} << i;
    }
    return Candidates(indices, known);
  }

 private:
  struct Neighbour {
    int dx, dy;
    ptrdiff_t linear;
  };

  bool inside(uint32_t x, uint32_t y) const {
    return x >= reach_ && y >= reach_ && x + reach_ < width_ && y + reach_ < height_;
  }

  static bool reaches(uint32_t at, int offset, uint32_t size) {
    const int64_t place = int64_t{at} + offset;
    return place >= 0 && place < size;
  }

  void add(int dx, int dy) {
    neighbours_[static_cast<size_t>(count_++)] = {dx, dy, dy * static_cast<ptrdiff_t>(width_) + dx};
  }

  const KeptIndex* indices_;
  uint32_t width_, height_, reach_ = 0;
  std::array<Neighbour, Candidates::kNeighbours> neighbours_{};
  int count_ = 0;  ///< roots have no neighbours
};

}  // namespace tetrakis::inline drawing
