// SPDX-License-Identifier: Apache-2.0
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
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace tetrakis::inline lifting {

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

}  // namespace tetrakis::inline lifting
