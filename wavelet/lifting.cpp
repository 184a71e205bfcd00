// SPDX-License-Identifier: Apache-2.0
#include "wavelet/lifting.hpp"

#include <algorithm>

#include "wavelet/lifting_kernel.hpp"

namespace tetrakis {

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
      LiftingSources sources{};
      for (size_t k = 0; k < step.pairs; ++k) {
        const auto distance = static_cast<ptrdiff_t>(2 * k + 1);
        sources.before[k] = row(t - distance);
        sources.after[k] = row(t + distance);
      }
      liftStep(row(t), sources, {step, filter.shift, direction, wide}, rows.width);
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
    LiftingSources sources{};
    for (size_t k = 0; k < step.pairs; ++k) {
      const auto distance = static_cast<ptrdiff_t>(k);
      sources.before[k] = source - distance - parity;
      sources.after[k] = source + distance + 1 - parity;
    }
    liftStep(predicts ? high() : low(), sources, {step, filter.shift, direction, wide},
             static_cast<size_t>(predicts ? highs : lows));
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
