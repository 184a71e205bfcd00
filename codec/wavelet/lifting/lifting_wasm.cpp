// SPDX-License-Identifier: Apache-2.0
// The vectors of WebAssembly, for exact sums alone: compilers make vectors of sums that wrap by
// themselves, but none of products of 64 bits. Samples are taken apart as
// codec/wavelet/lifting/lifting_avx2.cpp says.
#include "codec/wavelet/lifting/lifting_kernel.hpp"

#if defined(__wasm_simd128__)

#include <wasm_simd128.h>

namespace tetrakis::inline lifting {

namespace {

constexpr size_t kLanes = 4;

/// Even places of 16 bits from one, odd ones from the other. Places stay what they are: engines
/// have an instruction for that.
inline v128_t blend(v128_t even, v128_t odd) {
  return wasm_i16x8_shuffle(even, odd, 0, 9, 2, 11, 4, 13, 6, 15);
}

/// Sums of products of the halves of samples.
struct HalfSums {
  v128_t low, high;

  void add(v128_t a, v128_t b, v128_t weight) {
    const v128_t lows = blend(a, wasm_i32x4_shl(b, 16)), highs = blend(wasm_u32x4_shr(a, 16), b);
    const v128_t bias = wasm_i16x8_const_splat(-0x8000);
    low = wasm_i32x4_add(low, wasm_i32x4_dot_i16x8(wasm_v128_xor(lows, bias), weight));
    high = wasm_i32x4_add(high, wasm_i32x4_dot_i16x8(highs, weight));
  }
};

template <size_t kPairs>
void liftExactly(int32_t* __restrict target, const LiftingSources& sources, const LiftingRule& rule,
                 size_t count) {
  const LiftingSources from = sources;
  const int shift = rule.shift;
  v128_t weights[kPairs];
  int32_t start = 1 << (shift - 1);
  for (size_t k = 0; k < kPairs; ++k) {
    weights[k] = wasm_i16x8_splat(rule.step.weights[k]);
    start += rule.step.weights[k] * 0x10000;
  }
  // change ^ sign - sign is change or, with all bits of sign set, -change.
  const v128_t sign = wasm_i32x4_splat(rule.direction == Direction::kAnalysis ? 0 : -1);
  for (size_t j = 0; j < count; j += kLanes) {
    HalfSums sums{wasm_i32x4_splat(start), wasm_i32x4_const_splat(0)};
    for (size_t k = 0; k < kPairs; ++k)
      sums.add(wasm_v128_load(from.before[k] + j), wasm_v128_load(from.after[k] + j), weights[k]);
    const v128_t change =
        wasm_i32x4_add(wasm_i32x4_shl(sums.high, 16 - shift), wasm_i32x4_shr(sums.low, shift));
    const v128_t value = wasm_i32x4_add(wasm_v128_load(target + j), wasm_v128_xor(change, sign));
    wasm_v128_store(target + j, wasm_i32x4_sub(value, sign));
  }
}

}  // namespace

size_t liftStepVectors(int32_t* target, const LiftingSources& sources, const LiftingRule& rule,
                       size_t count) {
  if (!rule.wide) return 0;
  const size_t whole = count - count % kLanes;
  switch (rule.step.pairs) {
    case 1:
      liftExactly<1>(target, sources, rule, whole);
      break;
    case 2:
      liftExactly<2>(target, sources, rule, whole);
      break;
    case 3:
      liftExactly<3>(target, sources, rule, whole);
      break;
    default:
      liftExactly<kMaxPairs>(target, sources, rule, whole);
  }
  return whole;
}

}  // namespace tetrakis::inline lifting

#endif
