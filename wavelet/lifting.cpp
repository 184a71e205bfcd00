// SPDX-License-Identifier: Apache-2.0
#include "wavelet/lifting.hpp"

#include <algorithm>

namespace tetrakis {

namespace {

/// target[j] += or -= the rounded weighted sum of pairs about source[j] and source[j + lanes].
template <class Sum, size_t kPairs, bool kAdd>
void lift(int32_t* __restrict target, const int32_t* __restrict source, const int16_t* weights,
          int shift, ptrdiff_t values, ptrdiff_t lanes) {
  using Unsigned = std::make_unsigned_t<Sum>;
  const auto pair = [&](ptrdiff_t a, ptrdiff_t b) {
    return static_cast<Unsigned>(Sum{source[a]}) + static_cast<Unsigned>(Sum{source[b]});
  };
  const Unsigned half = Unsigned{1} << (shift - 1);
  for (ptrdiff_t j = 0; j < values; ++j) {
    Unsigned sum = half;
    for (ptrdiff_t k = 0; k < static_cast<ptrdiff_t>(kPairs); ++k) {
      sum += static_cast<Unsigned>(Sum{weights[k]}) * pair(j - k * lanes, j + (k + 1) * lanes);
    }
    const auto change = static_cast<uint32_t>(static_cast<Sum>(sum) >> shift);
    const auto value = static_cast<uint32_t>(target[j]);
    target[j] = static_cast<int32_t>(kAdd ? value + change : value - change);
  }
}

/// Position p of a signal of n >= 2 samples that is mirrored about both ends.
ptrdiff_t mirror(ptrdiff_t p, ptrdiff_t n) {
  const ptrdiff_t period = 2 * (n - 1);
  p = ((p % period) + period) % period;
  return std::min(p, period - p);
}

}  // namespace

// Mirroring keeps even positions even (the ends are mirrored about samples), so each half has its
// margins from itself.
void LiftingLine::mirrorLow(ptrdiff_t reach) {
  const ptrdiff_t last = lows() - 1;
  for (ptrdiff_t i = 1; i <= reach; ++i) {
    std::copy_n(low(mirror(-2 * i, length_) / 2), lanes_, low(-i));
    std::copy_n(low(mirror(2 * (last + i), length_) / 2), lanes_, low(last + i));
  }
}

void LiftingLine::mirrorHigh(ptrdiff_t reach) {
  const ptrdiff_t last = highs() - 1;
  for (ptrdiff_t i = 1; i <= reach; ++i) {
    std::copy_n(high(mirror(1 - 2 * i, length_) / 2), lanes_, high(-i));
    std::copy_n(high(mirror(2 * (last + i) + 1, length_) / 2), lanes_, high(last + i));
  }
}

template <class Sum, bool kAdd>
void LiftingLine::step(const LiftingStep& step, int shift, bool predicts) {
  const auto reach = static_cast<ptrdiff_t>(step.pairs);
  predicts ? mirrorLow(reach) : mirrorHigh(reach);
  int32_t* target = predicts ? high(0) : low(0);
  const int32_t* source = predicts ? low(0) : high(-1);
  const ptrdiff_t values = lanes_ * (predicts ? highs() : lows());
  const int16_t* weights = step.weights.data();
  switch (step.pairs) {
    case 1:
      return lift<Sum, 1, kAdd>(target, source, weights, shift, values, lanes_);
    case 2:
      return lift<Sum, 2, kAdd>(target, source, weights, shift, values, lanes_);
    case 3:
      return lift<Sum, 3, kAdd>(target, source, weights, shift, values, lanes_);
    default:
      return lift<Sum, kMaxPairs, kAdd>(target, source, weights, shift, values, lanes_);
  }
}

void LiftingLine::analyse(FilterId id, bool wide) {
  const LiftingFilter filter = liftingFilter(id);
  for (size_t i = 0; i < filter.steps.size(); ++i) {
    const bool predicts = i % 2 == 0;
    wide ? step<int64_t, true>(filter.steps[i], filter.shift, predicts)
         : step<int32_t, true>(filter.steps[i], filter.shift, predicts);
  }
}

void LiftingLine::synthesise(FilterId id, bool wide) {
  const LiftingFilter filter = liftingFilter(id);
  for (size_t i = filter.steps.size(); i-- > 0;) {
    const bool predicts = i % 2 == 0;
    wide ? step<int64_t, false>(filter.steps[i], filter.shift, predicts)
         : step<int32_t, false>(filter.steps[i], filter.shift, predicts);
  }
}

}  // namespace tetrakis
