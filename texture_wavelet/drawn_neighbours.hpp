// SPDX-License-Identifier: Apache-2.0
// What the known neighbours of a vertex say about its colour: they vote.
//
//   near     the 4 coarser vertices next to it: diagonal ones for a centre, along the axes for a
//            midpoint; 6 votes each
//   causal   2 vertices of its own level that came before: (-2s, 0) and (0, -2s) for a centre,
//            (-s, -s) and (s, -s) for a midpoint; 4 votes each
//   ring     the 8 coarser vertices at sqrt 5 times the distance of near; 1 vote each
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "lattice/levels.hpp"
#include "lattice/stencil.hpp"
#include "texture_wavelet/drawn_colours.hpp"

namespace tetrakis {

/// A colour among the neighbours.
struct Candidate {
  ColourIndex colour = kNoColour;
  uint32_t pattern = 0;  ///< of the neighbours that have it: bits 0-3 near, 4-5 causal, 6-13 ring
  int votes = 0;

  int near() const { return std::popcount(pattern & 0xf); }
  int causal() const { return std::popcount(pattern >> 4 & 3); }
  int ring() const { return std::popcount(pattern >> 6); }
};

/// The candidates around one vertex: the first three by votes, of equal ones the first met.
class Candidates {
 public:
  static constexpr int kRanked = 3;

  /// neighbour: its bit in the patterns.
  void meet(ColourIndex colour, int neighbour) {
    const auto end = all_.begin() + count_;
    const auto found =
        std::find_if(all_.begin(), end, [&](const Candidate& c) { return c.colour == colour; });
    if (found == end) all_[static_cast<size_t>(count_++)] = {colour, 0, 0};
    found->pattern |= 1u << neighbour;
    found->votes += neighbour < 4 ? 6 : neighbour < 6 ? 4 : 1;
  }

  /// After the last meet().
  void rank() {
    for (int place = 0; place < std::min(kRanked, count_ - 1); ++place) {
      const auto first = all_.begin() + place;
      const auto best = std::max_element(
          first, all_.begin() + count_,
          [](const Candidate& a, const Candidate& b) { return a.votes < b.votes; });
      std::rotate(first, best, best + 1);
    }
  }

  int count() const { return count_; }
  const Candidate& operator[](int place) const { return all_[static_cast<size_t>(place)]; }

 private:
  static constexpr int kMost = Stencil::kTaps + 2;

  std::array<Candidate, kMost> all_;
  int count_ = 0;
};

/// Collects the candidates of the vertices of one level. indices: width * height, row by row.
class Neighbourhood {
 public:
  Neighbourhood(const Level& level, std::span<const ColourIndex> indices, uint32_t width,
                uint32_t height)
      : indices_(indices.data()), width_(width), height_(height) {
    if (level.kind == LevelKind::kRoots) return;
    const Stencil stencil = stencilOf(level.kind, level.step, width);
    const int s = static_cast<int>(level.step);
    const bool centre = level.kind == LevelKind::kCentres;
    constexpr int kNear = Stencil::kRingSize[0];
    for (int tap = 0; tap < kNear; ++tap) add(stencil.dx[tap], stencil.dy[tap]);
    add(centre ? -2 * s : -s, centre ? 0 : -s);
    add(centre ? 0 : s, centre ? -2 * s : -s);
    for (int tap = kNear; tap < Stencil::kTaps; ++tap) add(stencil.dx[tap], stencil.dy[tap]);
    reach_ = static_cast<uint32_t>(stencil.reach);
  }

  Candidates around(uint32_t x, uint32_t y) const {
    Candidates candidates;
    const bool inside = x >= reach_ && y >= reach_ && x + reach_ < width_ && y + reach_ < height_;
    for (int i = 0; i < count_; ++i) {
      const Neighbour& n = neighbours_[static_cast<size_t>(i)];
      if (!inside && !(reaches(x, n.dx, width_) && reaches(y, n.dy, height_))) continue;
      candidates.meet(indices_[static_cast<ptrdiff_t>(size_t{y} * width_ + x) + n.linear], i);
    }
    candidates.rank();
    return candidates;
  }

 private:
  struct Neighbour {
    int dx, dy;
    ptrdiff_t linear;
  };

  static bool reaches(uint32_t at, int offset, uint32_t size) {
    const int64_t place = int64_t{at} + offset;
    return place >= 0 && place < size;
  }

  void add(int dx, int dy) {
    neighbours_[static_cast<size_t>(count_++)] = {dx, dy, dy * static_cast<ptrdiff_t>(width_) + dx};
  }

  const ColourIndex* indices_;
  uint32_t width_, height_, reach_ = 0;
  std::array<Neighbour, Stencil::kTaps + 2> neighbours_{};
  int count_ = 0;
};

}  // namespace tetrakis
