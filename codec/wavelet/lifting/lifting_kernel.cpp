// SPDX-License-Identifier: Apache-2.0
// The weights of the filters, which liftingFilter() hands out, and liftStepScalar(), which
// specifies the kernel.
#include "codec/wavelet/lifting/lifting_kernel.hpp"

#include <type_traits>

namespace tetrakis::inline lifting {

// The weights. Every filter keeps constants out of its high band: predictions of two-step filters
// sum to -1 exactly, and the sums A, B, C of the first three of four steps are chosen among
// multiples of 2^-shift so that 1 + 2 A + 2 C (1 + 2 B (1 + 2 A)) is below 10^-7. Flat ground then
// costs nothing.

namespace {

/// 5/3 (LeGall): drawn maps, text, steps.
constexpr std::array<LiftingStep, 2> kShortSteps = {{{1, {-128}}, {1, {64}}}};

/// Fitted to the rate of ten aerial images at 0.02 to 3 bits a sample.
constexpr std::array<LiftingStep, 2> kSixTapSteps = {{{3, {-147, 28, -9}}, {3, {78, -20, 6}}}};

/// For lossy streams: the four steps of 9/7 (Cohen, Daubechies, Feauveau), without its scaling,
/// with a second pair of taps in each. Fitted by CMA-ES (N. Hansen 2001) to the PSNR that decoded
/// parts of nine aerial images and maps have at 15 rates from 0.1 to 2 bits. It is closer to
/// orthogonal than 9/7: with functions of norm 1, errors of equal energy are synthesised with
/// amplitudes that differ by a factor of 1.23 at most (9/7 1.28, kLong 1.78).
constexpr std::array<LiftingStep, 4> kOrthogonalSteps = {
    {{2, {-7895, 81}}, {2, {-258, 64}}, {2, {4447, 105}}, {2, {2189, -297}}}};

/// For coarse levels of lossless images: nearly as orthogonal as kOrthogonal. Its first step does
/// nothing. All further weights are below 1, where kOrthogonal multiplies roundings by 1.9, and the
/// gain of 1.31 makes roundings of coarse levels count less. Fitted by CMA-ES to what integer
/// coefficients of second levels of eight images cost, at three steps and to the last bit.
constexpr std::array<LiftingStep, 4> kQuietSteps = {
    {{1, {0}}, {2, {1435, -176}}, {3, {-3653, 706, -186}}, {3, {2218, -254, 116}}}};

/// The interpolation of degree 5 (G. Deslauriers and S. Dubuc, "Symmetric iterative interpolation
/// processes", 1989): details of surfaces that are locally such polynomials are 0. The others leave
/// a part of what is quadratic in all details.
constexpr std::array<LiftingStep, 2> kSmoothSteps = {{{3, {-150, 25, -3}}, {3, {75, -13, 2}}}};

/// Ten taps, close to an ideal half-band filter: terrain models are sampled finely.
constexpr std::array<LiftingStep, 2> kLongSteps = {
    {{5, {-157, 41, -17, 8, -3}}, {5, {77, -24, 12, -6, 2}}}};

}  // namespace

LiftingFilter liftingFilter(FilterId id) {
  switch (id) {
    case FilterId::kShort:
      return {8, kShortSteps};
    case FilterId::kSixTap:
      return {8, kSixTapSteps};
    case FilterId::kQuiet:
      return {13, kQuietSteps};
    case FilterId::kOrthogonal:
      return {12, kOrthogonalSteps};
    case FilterId::kSmooth:
      return {8, kSmoothSteps};
    case FilterId::kLong:
      break;
  }
  return {8, kLongSteps};
}

int64_t inverseGain(FilterId id) {
  // Of four steps: 1 / (1 + 2 B (1 + 2 A)); the last adds next to nothing to constants.
  if (id == FilterId::kOrthogonal) return 847671299;
  return id == FilterId::kQuiet ? 821297201 : int64_t{1} << 30;
}

uint32_t synthesisReach(FilterId id) {
  uint32_t reach = 0;
  for (const LiftingStep& step : liftingFilter(id).steps)
    reach += static_cast<uint32_t>(2 * step.pairs - 1);
  return reach;
}

int widestSamples(FilterId id) {
  return id == FilterId::kQuiet || id == FilterId::kOrthogonal ? 15 : 20;
}

namespace {

template <class Sum, size_t kPairs>
void lift(int32_t* __restrict target, const LiftingSources& sources, const LiftingRule& rule,
          size_t count) {
  using Unsigned = std::make_unsigned_t<Sum>;
  const LiftingSources from = sources;
  const int shift = rule.shift;
  std::array<Unsigned, kPairs> weights;
  for (size_t k = 0; k < kPairs; ++k) weights[k] = static_cast<Unsigned>(Sum{rule.step.weights[k]});
  const Unsigned half = Unsigned{1} << (shift - 1);
  // change ^ sign - sign is change or, with all bits of sign set, -change.
  const uint32_t sign = rule.direction == Direction::kAnalysis ? 0 : ~uint32_t{0};
  for (size_t j = 0; j < count; ++j) {
    Unsigned sum = half;
    for (size_t k = 0; k < kPairs; ++k) {
      sum += weights[k] * (static_cast<Unsigned>(Sum{from.before[k][j]}) +
                           static_cast<Unsigned>(Sum{from.after[k][j]}));
    }
    const auto change = static_cast<uint32_t>(static_cast<Sum>(sum) >> shift);
    const auto value = static_cast<uint32_t>(target[j]);
    target[j] = static_cast<int32_t>(value + (change ^ sign) - sign);
  }
}

template <class Sum>
void liftPairs(int32_t* target, const LiftingSources& sources, const LiftingRule& rule,
               size_t count) {
  switch (rule.step.pairs) {
    case 1:
      return lift<Sum, 1>(target, sources, rule, count);
    case 2:
      return lift<Sum, 2>(target, sources, rule, count);
    case 3:
      return lift<Sum, 3>(target, sources, rule, count);
    default:
      return lift<Sum, kMaxPairs>(target, sources, rule, count);
  }
}

}  // namespace

void liftStep(int32_t* target, const LiftingSources& sources, const LiftingRule& rule,
              size_t count) {
  const size_t done = liftStepVectors(target, sources, rule, count);
  LiftingSources rest = sources;
  for (size_t k = 0; k < rule.step.pairs; ++k) {
    rest.before[k] += done;
    rest.after[k] += done;
  }
  liftStepScalar(target + done, rest, rule, count - done);
}

void liftStepScalar(int32_t* target, const LiftingSources& sources, const LiftingRule& rule,
                    size_t count) {
  rule.wide ? liftPairs<int64_t>(target, sources, rule, count)
            : liftPairs<int32_t>(target, sources, rule, count);
}

}  // namespace tetrakis::inline lifting
