// SPDX-License-Identifier: Apache-2.0
// The vectors of AVX2. Sums that wrap are 32-bit arithmetic as it stands. For exact sums, which
// have up to 50 bits, samples are taken apart,
//
//   x = 2^16 high + low + 2^15,   low in [-2^15, 2^15)
//
// and a pair adds 2^16 (w a_high + w b_high) + (w a_low + w b_low) + 2^16 w: one instruction adds a
// pair of 16-bit products. The magnitudes of the weights of a step sum to at most 2^14, so both
// sums stay below 2^31 and nothing is lost:
//
//   (2^16 H + L) >> shift = 2^(16 - shift) H + (L >> shift)      for shift < 16
#include "codec/wavelet/lifting/lifting_kernel.hpp"

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#define TETRAKIS_AVX2 __attribute__((target("avx2")))

namespace tetrakis::inline lifting {

namespace {

constexpr size_t kLanes = 8;

TETRAKIS_AVX2 inline __m256i load(const int32_t* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}

TETRAKIS_AVX2 inline void store(__m256i values, int32_t* to) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), values);
}

/// Each weight in all places, 32 bits for sums that wrap, 16 bits for exact ones; and what every
/// sum starts with.
struct Constants {
  __m256i weights[kMaxPairs];
  __m256i start;
};

TETRAKIS_AVX2 inline Constants constantsOf(const LiftingRule& rule) {
  Constants constants;
  int32_t start = 1 << (rule.shift - 1);
  for (size_t k = 0; k < rule.step.pairs; ++k) {
    const int16_t weight = rule.step.weights[k];
    constants.weights[k] = rule.wide ? _mm256_set1_epi16(weight) : _mm256_set1_epi32(weight);
    if (rule.wide) start += weight * 0x10000;
  }
  constants.start = _mm256_set1_epi32(start);
  return constants;
}

template <size_t kPairs>
TETRAKIS_AVX2 inline __m256i wrappedChange(const LiftingSources& from, const Constants& constants,
                                           __m128i shift, size_t j) {
  __m256i sum = constants.start;
  for (size_t k = 0; k < kPairs; ++k) {
    const __m256i pair = _mm256_add_epi32(load(from.before[k] + j), load(from.after[k] + j));
    sum = _mm256_add_epi32(sum, _mm256_mullo_epi32(pair, constants.weights[k]));
  }
  return _mm256_sra_epi32(sum, shift);
}

template <size_t kPairs>
TETRAKIS_AVX2 inline __m256i exactChange(const LiftingSources& from, const Constants& constants,
                                         __m128i shift, size_t j) {
  constexpr int kLowHalves = 0x55;
  const __m256i bias = _mm256_set1_epi16(-0x8000);
  __m256i low_sum = constants.start, high_sum = _mm256_setzero_si256();
  for (size_t k = 0; k < kPairs; ++k) {
    const __m256i a = load(from.before[k] + j), b = load(from.after[k] + j);
    const __m256i low = _mm256_blend_epi16(_mm256_slli_epi32(b, 16), a, kLowHalves);
    const __m256i high = _mm256_blend_epi16(b, _mm256_srli_epi32(a, 16), kLowHalves);
    const __m256i weight = constants.weights[k];
    low_sum = _mm256_add_epi32(low_sum, _mm256_madd_epi16(_mm256_xor_si256(low, bias), weight));
    high_sum = _mm256_add_epi32(high_sum, _mm256_madd_epi16(high, weight));
  }
  const __m128i left = _mm_sub_epi64(_mm_cvtsi32_si128(16), shift);
  return _mm256_add_epi32(_mm256_sll_epi32(high_sum, left), _mm256_sra_epi32(low_sum, shift));
}

/// count: kLanes or more. The last vector ends with the last target, and so begins with targets of
/// the one before where these do not fill whole vectors; it is worked out while they are as they
/// were.
template <size_t kPairs, bool kWide>
TETRAKIS_AVX2 void lift(int32_t* target, const LiftingSources& sources, const LiftingRule& rule,
                        size_t count) {
  const LiftingSources from = sources;
  const Constants constants = constantsOf(rule);
  const __m128i shift = _mm_cvtsi32_si128(rule.shift);
  // -c is ~c + 1.
  const __m256i sign = _mm256_set1_epi32(rule.direction == Direction::kAnalysis ? 0 : -1);
  const auto lifted = [&](size_t j) TETRAKIS_AVX2 {
    const __m256i change = kWide ? exactChange<kPairs>(from, constants, shift, j)
                                 : wrappedChange<kPairs>(from, constants, shift, j);
    const __m256i value = _mm256_add_epi32(load(target + j), _mm256_xor_si256(change, sign));
    return _mm256_sub_epi32(value, sign);
  };
  const size_t last = count - kLanes;
  const __m256i end = lifted(last);
  for (size_t j = 0; j < last; j += kLanes) store(lifted(j), target + j);
  store(end, target + last);
}

template <bool kWide>
void liftPairs(int32_t* target, const LiftingSources& sources, const LiftingRule& rule,
               size_t count) {
  switch (rule.step.pairs) {
    case 1:
      return lift<1, kWide>(target, sources, rule, count);
    case 2:
      return lift<2, kWide>(target, sources, rule, count);
    case 3:
      return lift<3, kWide>(target, sources, rule, count);
    default:
      return lift<kMaxPairs, kWide>(target, sources, rule, count);
  }
}

}  // namespace

size_t liftStepVectors(int32_t* target, const LiftingSources& sources, const LiftingRule& rule,
                       size_t count) {
  static const bool supported = __builtin_cpu_supports("avx2");
  if (!supported || count < kLanes) return 0;
  rule.wide ? liftPairs<true>(target, sources, rule, count)
            : liftPairs<false>(target, sources, rule, count);
  return count;
}

}  // namespace tetrakis::inline lifting

#elif !defined(__wasm_simd128__)  // codec/wavelet/lifting/lifting_wasm.cpp has those

namespace tetrakis::inline lifting {

size_t liftStepVectors(int32_t*, const LiftingSources&, const LiftingRule&, size_t) {
  return 0;
}

}  // namespace tetrakis::inline lifting

#endif
