// SPDX-License-Identifier: Apache-2.0
// The weights. Except for kOrthogonal the predictions keep constants out of the high band exactly
// (they sum to -128), so flat ground costs nothing.
#include "wavelet/lifting_filter.hpp"

namespace tetrakis {

namespace {

/// 5/3 (LeGall): drawn maps, text, steps.
constexpr std::array<LiftingStep, 2> kShortSteps = {{{1, {-128}}, {1, {64}}}};

/// Fitted to the rate of ten aerial images at 0.02 to 3 bits a sample.
constexpr std::array<LiftingStep, 2> kSixTapSteps = {{{3, {-147, 28, -9}}, {3, {78, -20, 6}}}};

/// 9/7 (Cohen, Daubechies, Feauveau) without its scaling: nearly orthogonal, best for images at low
/// rates.
constexpr std::array<LiftingStep, 4> kOrthogonalSteps = {
    {{1, {-406}}, {1, {-14}}, {1, {226}}, {1, {114}}}};

/// Ten taps, close to an ideal half-band filter: terrain models are sampled finely.
constexpr std::array<LiftingStep, 2> kLongSteps = {
    {{5, {-157, 41, -17, 8, -3}}, {5, {77, -24, 12, -6, 2}}}};

}  // namespace

std::span<const LiftingStep> liftingSteps(FilterId id) {
  switch (id) {
    case FilterId::kShort:
      return kShortSteps;
    case FilterId::kSixTap:
      return kSixTapSteps;
    case FilterId::kOrthogonal:
      return kOrthogonalSteps;
    case FilterId::kLong:
      break;
  }
  return kLongSteps;
}

}  // namespace tetrakis
