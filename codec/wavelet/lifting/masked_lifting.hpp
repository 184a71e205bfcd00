// SPDX-License-Identifier: Apache-2.0
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
#pragma once

#include <cstdint>
#include <vector>

#include "codec/wavelet/lifting/lifting_steps.hpp"

namespace tetrakis::inline lifting {

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

}  // namespace tetrakis::inline lifting
