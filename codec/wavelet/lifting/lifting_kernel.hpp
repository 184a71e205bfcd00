// SPDX-License-Identifier: Apache-2.0
// liftStep() adds one lifting step to many signals at once; all lifting is made of it. The scalar
// kernel is the specification, and liftStep() uses the vectors of the processor where it has
// suitable ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "codec/wavelet/lifting/lifting_filter.hpp"

namespace tetrakis::inline lifting {

enum class Direction : uint8_t { kAnalysis, kSynthesis };

/// The two sources of each pair, for all targets of a call: pair k of target j is before[k][j] and
/// after[k][j].
template <class T>
struct StepSources {
  std::array<const T*, kMaxPairs> before, after;
};

/// Samples, of which a step weighs the sums of the pairs.
using LiftingSources = StepSources<int32_t>;

/// What is done to every target: += in analysis, -= in synthesis, modulo 2^32.
struct LiftingRule {
  const LiftingStep& step;
  int shift;  ///< weights are in units of 2^-shift; 1 to 15
  Direction direction;
  bool wide;  ///< sums are exact, else they wrap modulo 2^32
};

/// target: `count` values, apart from the sources.
void liftStep(int32_t* target, const LiftingSources& sources, const LiftingRule& rule,
              size_t count);

/// Says by plain arithmetic what liftStep() means.
void liftStepScalar(int32_t* target, const LiftingSources& sources, const LiftingRule& rule,
                    size_t count);

/// Does the step for as many of the first targets as the processor's vectors can do, and returns
/// how many these are: 0 if it has no vectors.
size_t liftStepVectors(int32_t* target, const LiftingSources& sources, const LiftingRule& rule,
                       size_t count);

}  // namespace tetrakis::inline lifting
