// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/lifting/lifting_kernel.hpp"

#include <type_traits>

namespace tetrakis::inline lifting {

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
