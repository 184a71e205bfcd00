// SPDX-License-Identifier: Apache-2.0
// Lifting turns the rows and columns of a plane into low and high halves and back, in place:
// liftColumns() and RowLifting where all samples exist, liftMaskedColumns() and MaskedRowLifting
// beside voids, JointLifting rows and columns in one go.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "codec/wavelet/lifting/lifting_steps.hpp"

namespace tetrakis::inline lifting {

// Lifting works on one-dimensional signals: the columns and the rows of a plane. A signal has two
// samples or more. Columns are mirrored about their first and their last sample; rows as well, or
// their ends are joined (lifting_steps.hpp). With 64-bit (wide) sums the results are exact; without
// them sums wrap modulo 2^32.
//
// The neighbours of the other parity change element t of a signal:
//
//   x[t] += round(sum_k w_k (x[t - 1 - 2k] + x[t + 1 + 2k]) / 2^shift)

/// Lifts all columns of a set of rows at once, in place: low rows stay at even indices, high ones
/// at odd indices.
void liftColumns(const Rows<int32_t>& rows, FilterId id, Direction direction, bool wide);

/// Lifts single rows. The low half lies before the high half.
class RowLifting {
 public:
  RowLifting(uint32_t longest, Ends ends) : halves_(longest, ends) {}

  void analyse(int32_t* row, uint32_t length, FilterId id, bool wide);
  void synthesise(int32_t* row, uint32_t length, FilterId id, bool wide);
  /// Low values stay at even places, high ones at odd places, as in columns.
  void liftInPlace(std::span<int32_t> signal, FilterId id, Direction direction, bool wide);

 private:
  void run(FilterId id, Direction direction, bool wide);

  Halves<int32_t> halves_;
};

// liftMaskedColumns() and MaskedRowLifting lift signals in which some samples do not exist (after
// S. Li and W. Li, "Shape-adaptive discrete wavelet transforms", IEEE TCSVT 10(5), 2000). A void is
// neither read nor changed, so nothing bleeds across a coast:
//
//   a neighbour that is void takes the value of its mirror image about the target,
//   a pair of which both are void takes the values of the pair before it, or, if all pairs before
//   it are void, of the first pair that is not; a target whose pairs are all void stays as it is.
//
// Constants are predicted exactly as long as one pair is left. All sums are exact, so that nothing
// depends on where the voids are.

/// One step of many signals at once: through liftStep(), and of the targets that are void or have a
/// void neighbour once more by themselves.
class MaskedStep {
 public:
  /// What a step changes: `count` values, and 1 for each that exists.
  struct Targets {
    int32_t* values;
    const uint8_t* valid;
    size_t count;
  };

  /// existing: 1 where a source exists, else 0.
  void lift(const Targets& targets, const LiftingSources& sources,
            const StepSources<uint8_t>& existing, const LiftingRule& rule);

 private:
  static constexpr size_t kBlock = 64;

  void findRegular(const uint8_t* valid, const StepSources<uint8_t>& exist, size_t pairs,
                   size_t count);

  std::vector<uint8_t> regular_;  ///< 1 where neither target nor sources are void
};

/// Does what liftColumns() does where some samples do not exist. valid: the mask of the rows, as
/// they lie.
void liftMaskedColumns(const Rows<int32_t>& rows, const Rows<const uint8_t>& valid, FilterId id,
                       Direction direction);

/// Does what RowLifting does where some samples do not exist. valid: the mask of the row, the low
/// half before the high half.
class MaskedRowLifting {
 public:
  MaskedRowLifting(uint32_t longest, Ends ends) : values_(longest, ends), valid_(longest, ends) {}

  void analyse(int32_t* row, const uint8_t* valid, uint32_t length, FilterId id);
  void synthesise(int32_t* row, const uint8_t* valid, uint32_t length, FilterId id);

 private:
  void run(FilterId id, Direction direction);

  Halves<int32_t> values_;
  Halves<uint8_t> valid_;
  MaskedStep step_;
};

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

inline constexpr int kJointPlaces = 4;

/// Whether a filter has no more than the two steps that joint lifting is made of.
bool liftsJointly(FilterId id);

/// A filter of more steps lifts in so many rounds, two steps in each: steps along rows and steps
/// along columns could change places, but for their roundings.
size_t jointRounds(FilterId id);

/// What is known of samples that are held (codec/wavelet/held_cells.hpp).
struct JointHeld {
  const uint16_t* numbers = nullptr;  ///< of each value of a block: 0, or 1 + its area
  /// Of each area what JointLifting::raised() and lowered() are.
  const int32_t *raised = nullptr, *lowered = nullptr;
};

/// What is split: rows at equal distances, even ones low and odd ones high. In the transform the
/// low half of each row lies before the high half.
struct JointBlock {
  int32_t* first;
  size_t pitch;         ///< from one row to the next, in values
  Extent extent;        ///< two samples or more in each direction
  Ends ends;            ///< of the rows
  bool doubled;         ///< a becomes 2 a + [2 (...)]: coarser levels then round half as much
  size_t round = 0;     ///< of the filter's; a is doubled in the last one
  JointHeld held = {};  ///< without numbers: nothing is held
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

  /// The row c + Py a that changes d, and the row b - Uy d that changes a, with kJointPlaces binary
  /// places. Valid until another row is lifted.
  std::span<const int32_t> raised(uint32_t row);
  std::span<const int32_t> lowered(uint32_t row);

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
  /// Gives the values of their areas to what is held of half a row.
  void hold(uint32_t row, bool high, const int32_t* values, std::span<int32_t> half) const;
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
