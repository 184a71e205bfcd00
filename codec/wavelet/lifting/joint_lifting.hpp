// SPDX-License-Identifier: Apache-2.0
// Joint lifting splits rows and columns in one go and rounds every coefficient once, where lifting
// the rows and then the columns rounds it twice (after M. Iwahashi and H. Kiya, "Non separable 2D
// factorization of separable 2D DWT for lossless image coding", ICIP 2009). With the two steps P
// (predict) and U (update) of a filter along x and y, and a, b, c, d for what becomes LL, HL, LH
// and HH:
//
//   d += [Px (c + Py a) + Py b]
//   b += [Px a + Uy d]                    c += [Py a + Ux d]
//   a += [Ux (b - Uy d) + Uy c]
//
// Each line reads what the lines before it have left, so that the lines undo each other backwards.
// In the brackets values have kJointPlaces binary places, to which every product of P or U is
// rounded; the sum is rounded to a whole number. Without roundings that is the separable transform.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "codec/wavelet/lifting/lifting_steps.hpp"

namespace tetrakis::inline lifting {

inline constexpr int kJointPlaces = 4;

/// Whether a filter has the two steps that joint lifting is made of.
bool liftsJointly(FilterId id);

/// What is split: rows at equal distances, even ones low and odd ones high. In the transform the
/// low half of each row lies before the high half.
struct JointBlock {
  int32_t* first;
  size_t pitch;   ///< from one row to the next, in values
  Extent extent;  ///< two samples or more in each direction
  Ends ends;      ///< of the rows
  bool doubled;   ///< a becomes 2 a + [2 (...)]: coarser levels then round half as much
};

/// What analysis does, in this order; synthesis does it backwards.
enum class JointStep : uint8_t {
  kHalves,   ///< takes the rows apart
  kCentres,  ///< changes d
  kSides,    ///< changes b and c
  kCorners   ///< changes a
};

/// Lifts some rows of a block. All rows go through a step before any goes through the next.
class JointLifting {
 public:
  /// wide: sums are exact, else they wrap modulo 2^32.
  JointLifting(const JointBlock& block, FilterId id, Direction direction, bool wide);

  void run(JointStep step, uint32_t first_row, uint32_t end_row);

  static std::array<JointStep, 4> steps(Direction direction);

 private:
  /// The values that a step along the columns reads to change a row: at low or at high places.
  struct Columns {
    uint32_t row;
    bool high, predicts;
  };

  void orderHalves(uint32_t row);
  void centres(uint32_t row);
  void rightSides(uint32_t row);
  void lowerSides(uint32_t row);
  void corners(uint32_t row);

  std::span<int32_t> half(uint32_t row, bool high) const;
  LiftingRule ruleOf(bool predicts, int places, Direction direction) const;
  void addRow(bool predicts, int places);
  void addColumns(const Columns& of, Direction direction, std::span<int32_t> sums) const;
  void roundCorners(uint32_t row) const;
  void addRounded(int places, std::span<int32_t> target) const;

  JointBlock block_;
  LiftingFilter filter_;
  Direction direction_;
  bool wide_;
  Halves<int32_t> halves_;     ///< what a step along a row reads
  std::vector<int32_t> sums_;  ///< the brackets of a row
};

}  // namespace tetrakis::inline lifting
