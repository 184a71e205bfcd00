// SPDX-License-Identifier: Apache-2.0
// liftingFilter() gives the filters of the menu as lists of lifting steps, and liftStep() does one
// step of many signals at once: the only place where samples are weighed and rounded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tetrakis::inline lifting {

// liftingFilter() gives the wavelets of the menu. Each is a short list of lifting steps (W.
// Sweldens, "The lifting scheme", 1996; integer form: A. R. Calderbank et al., 1998). Steps
// alternate between predicting the odd samples from the even ones and updating the even ones from
// the odd ones:
//
//   predict   odd[i]  += round(sum_k w_k (even[i - k] + even[i + 1 + k]) / 2^shift)
//   update    even[i] += round(sum_k w_k (odd[i - 1 - k] + odd[i + k]) / 2^shift)
//
// The steps leave the low band in the even samples and the high band in the odd ones. A step adds a
// rounded number (half up) that the other samples alone determine, so every filter is exactly
// reversible.
//
// Terrain models are sampled finely and want long filters, images short and nearly orthogonal ones,
// drawn maps the shortest:
//
//   kShort        two taps a step (the 5/3)
//   kSixTap       six taps a step
//   kLong         ten taps a step, for rough terrain
//   kOrthogonal   four steps, nearly orthogonal: lossy images, and coarse levels of lossy terrain
//   kQuiet        likewise, with weights below 1, which keep roundings small: coarse levels of
//                 lossless images
//   kSmooth       no detail of polynomials up to degree 5, for ground without roughness

/// Which filter of the menu. The numbers stand in stream headers.
enum class FilterId : uint8_t {
  kShort = 0,
  kSixTap = 1,
  kQuiet = 2,
  kLong = 3,
  kSmooth = 4,
  kOrthogonal = 5
};
inline constexpr int kFilters = 6;

inline constexpr size_t kMaxPairs = 5;

struct LiftingStep {
  size_t pairs;                              ///< weights in use
  std::array<int16_t, kMaxPairs> weights{};  ///< of neighbour pairs, nearest first
};

struct LiftingFilter {
  int shift;                           ///< weights are in units of 2^-shift
  std::span<const LiftingStep> steps;  ///< in analysis order; the first predicts
};

LiftingFilter liftingFilter(FilterId id);

/// What the low band of constants has to be multiplied by to be those constants, in units of 2^-30.
int64_t inverseGain(FilterId id);

/// How far from a sample the coefficients lie that it is made of, in places of its level.
uint32_t synthesisReach(FilterId id);

/// Samples of more bits need 64-bit sums.
int widestSamples(FilterId id);

// liftStep() adds one lifting step to many signals at once; all lifting is made of it. The scalar
// kernel is the specification, and liftStep() uses the vectors of the processor where it has
// suitable ones.

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
