// SPDX-License-Identifier: Apache-2.0
#include "wavelet/lifting.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

namespace tetrakis {

namespace {

/// The two samples of each pair, for all targets of a call: pair k of target j is
/// before[k][j] + after[k][j].
struct Sources {
  std::array<const int32_t*, kMaxPairs> before, after;
};

template <class Sum, size_t kPairs, bool kAdd>
void lift(int32_t* __restrict target, const Sources& sources, const LiftingStep& step, int shift,
          size_t count) {
  using Unsigned = std::make_unsigned_t<Sum>;
  const Sources from = sources;
  std::array<Unsigned, kPairs> weights;
  for (size_t k = 0; k < kPairs; ++k) weights[k] = static_cast<Unsigned>(Sum{step.weights[k]});
  const Unsigned half = Unsigned{1} << (shift - 1);
  for (size_t j = 0; j < count; ++j) {
    Unsigned sum = half;
    for (size_t k = 0; k < kPairs; ++k) {
      sum += weights[k] * (static_cast<Unsigned>(Sum{from.before[k][j]}) +
                           static_cast<Unsigned>(Sum{from.after[k][j]}));
    }
    const auto change = static_cast<uint32_t>(static_cast<Sum>(sum) >> shift);
    const auto value = static_cast<uint32_t>(target[j]);
    target[j] = static_cast<int32_t>(kAdd ? value + change : value - change);
  }
}

template <class Sum, bool kAdd>
void liftPairs(int32_t* target, const Sources& sources, const LiftingStep& step, int shift,
               size_t count) {
  switch (step.pairs) {
    case 1:
      return lift<Sum, 1, kAdd>(target, sources, step, shift, count);
    case 2:
      return lift<Sum, 2, kAdd>(target, sources, step, shift, count);
    case 3:
      return lift<Sum, 3, kAdd>(target, sources, step, shift, count);
    default:
      return lift<Sum, kMaxPairs, kAdd>(target, sources, step, shift, count);
  }
}

void liftPairs(int32_t* target, const Sources& sources, const LiftingStep& step, int shift,
               size_t count, Direction direction, bool wide) {
  if (direction == Direction::kAnalysis) {
    wide ? liftPairs<int64_t, true>(target, sources, step, shift, count)
         : liftPairs<int32_t, true>(target, sources, step, shift, count);
  } else {
    wide ? liftPairs<int64_t, false>(target, sources, step, shift, count)
         : liftPairs<int32_t, false>(target, sources, step, shift, count);
  }
}

/// Position p of a signal of n >= 2 samples that is mirrored about both ends.
ptrdiff_t mirror(ptrdiff_t p, ptrdiff_t n) {
  if (p >= 0 && p < n) return p;
  const ptrdiff_t period = 2 * (n - 1);
  p = ((p % period) + period) % period;
  return std::min(p, period - p);
}

}  // namespace

void liftColumns(const RowSet& rows, FilterId id, Direction direction, bool wide) {
  // A step may follow when the one before has passed all rows that either of them reaches.
  constexpr auto kLag = static_cast<ptrdiff_t>(2 * kMaxPairs);
  const LiftingFilter filter = liftingFilter(id);
  const auto steps = static_cast<ptrdiff_t>(filter.steps.size());
  const ptrdiff_t n = rows.count;
  const auto row = [&](ptrdiff_t t) {
    return rows.first + static_cast<size_t>(mirror(t, n)) * rows.pitch;
  };
  for (ptrdiff_t front = 0; front < n + kLag * (steps - 1); ++front) {
    for (ptrdiff_t s = 0; s < steps; ++s) {
      const ptrdiff_t t = front - kLag * s;
      const ptrdiff_t index = direction == Direction::kAnalysis ? s : steps - 1 - s;
      if (t < 0 || t >= n || (t + index) % 2 == 0) continue;  // step 0 changes odd rows
      const LiftingStep& step = filter.steps[static_cast<size_t>(index)];
      Sources sources{};
      for (size_t k = 0; k < step.pairs; ++k) {
        const auto distance = static_cast<ptrdiff_t>(2 * k + 1);
        sources.before[k] = row(t - distance);
        sources.after[k] = row(t + distance);
      }
      liftPairs(row(t), sources, step, filter.shift, rows.width, direction, wide);
    }
  }
}

void RowLifting::run(ptrdiff_t length, FilterId id, Direction direction, bool wide) {
  const LiftingFilter filter = liftingFilter(id);
  const ptrdiff_t highs = length / 2, lows = length - highs;
  for (size_t i = 0; i < filter.steps.size(); ++i) {
    const size_t index = direction == Direction::kAnalysis ? i : filter.steps.size() - 1 - i;
    const LiftingStep& step = filter.steps[index];
    const bool predicts = index % 2 == 0;
    // Mirroring keeps even positions even, so each half has its margins from itself.
    int32_t* source = predicts ? low() : high();
    const ptrdiff_t count = predicts ? lows : highs, parity = predicts ? 0 : 1;
    for (ptrdiff_t m = 1; m <= static_cast<ptrdiff_t>(step.pairs); ++m) {
      source[-m] = source[mirror(parity - 2 * m, length) / 2];
      source[count - 1 + m] = source[mirror(parity + 2 * (count - 1 + m), length) / 2];
    }
    Sources sources{};
    for (size_t k = 0; k < step.pairs; ++k) {
      const auto distance = static_cast<ptrdiff_t>(k);
      sources.before[k] = source - distance - parity;
      sources.after[k] = source + distance + 1 - parity;
    }
    liftPairs(predicts ? high() : low(), sources, step, filter.shift,
              static_cast<size_t>(predicts ? highs : lows), direction, wide);
  }
}

void RowLifting::analyse(int32_t* row, uint32_t length, FilterId id, bool wide) {
  const uint32_t highs = length / 2, lows = length - highs;
  int32_t *even = low(), *odd = high();
  for (uint32_t i = 0; i < highs; ++i) {
    even[i] = row[2 * i];
    odd[i] = row[2 * i + 1];
  }
  if (lows > highs) even[highs] = row[2 * highs];
  run(length, id, Direction::kAnalysis, wide);
  std::copy_n(even, lows, row);
  std::copy_n(odd, highs, row + lows);
}

void RowLifting::synthesise(int32_t* row, uint32_t length, FilterId id, bool wide) {
  const uint32_t highs = length / 2, lows = length - highs;
  int32_t *even = low(), *odd = high();
  std::copy_n(row, lows, even);
  std::copy_n(row + lows, highs, odd);
  run(length, id, Direction::kSynthesis, wide);
  for (uint32_t i = 0; i < highs; ++i) {
    row[2 * i] = even[i];
    row[2 * i + 1] = odd[i];
  }
  if (lows > highs) row[2 * highs] = even[highs];
}

}  // namespace tetrakis
