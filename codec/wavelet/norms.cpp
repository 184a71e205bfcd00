// SPDX-License-Identifier: Apache-2.0
// Measured: an impulse goes through the one-dimensional synthesis.
#include "codec/wavelet/band_plan.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "base/portable_math.hpp"

namespace tetrakis::inline wavelet {

namespace {

constexpr int64_t kImpulse = int64_t{1} << 20;
/// Beyond so many splits a further one only stretches the function: the norm grows by the same
/// factor each time (sqrt 2 over the filter's gain for constants).
constexpr int kMeasuredLevels = 10;

/// A signal that is zero outside [origin, origin + values.size()).
struct Signal {
  ptrdiff_t origin = 0;
  std::vector<int64_t> values;

  int64_t at(ptrdiff_t i) const {
    const ptrdiff_t k = i - origin;
    return k >= 0 && k < static_cast<ptrdiff_t>(values.size()) ? values[static_cast<size_t>(k)] : 0;
  }
};

/// One inverse lifting step; the support of the target grows by the reach of the step.
void undo(const LiftingStep& step, int shift, bool predicts, const Signal& source, Signal& target) {
  if (source.values.empty()) return;
  const auto reach = static_cast<ptrdiff_t>(step.pairs);
  const ptrdiff_t left = predicts ? 0 : -1;  // the pair nearest to target i: i + left, i + left + 1
  const ptrdiff_t source_end = source.origin + static_cast<ptrdiff_t>(source.values.size());
  ptrdiff_t begin = source.origin - reach - left, end = source_end + reach - 1 - left;
  if (!target.values.empty()) {
    begin = std::min(begin, target.origin);
    end = std::max(end, target.origin + static_cast<ptrdiff_t>(target.values.size()));
  }
  // With zeros around it, so that the loop need not ask.
  const ptrdiff_t first = begin + left - (reach - 1);
  std::vector<int64_t> padded(static_cast<size_t>(end - begin + 2 * reach - 1));
  std::copy(source.values.begin(), source.values.end(), padded.begin() + (source.origin - first));
  Signal result{begin, std::vector<int64_t>(static_cast<size_t>(end - begin))};
  std::copy(target.values.begin(), target.values.end(),
            result.values.begin() + (target.values.empty() ? 0 : target.origin - begin));
  for (ptrdiff_t i = 0; i < end - begin; ++i) {
    const int64_t* nearest = padded.data() + i + reach - 1;
    int64_t sum = int64_t{1} << (shift - 1);
    for (ptrdiff_t k = 0; k < reach; ++k)
      sum += step.weights[static_cast<size_t>(k)] * (nearest[-k] + nearest[1 + k]);
    result.values[static_cast<size_t>(i)] -= sum >> shift;
  }
  target = std::move(result);
}

/// One level of synthesis.
Signal merge(FilterId id, Signal low, Signal high) {
  const LiftingFilter filter = liftingFilter(id);
  for (size_t i = filter.steps.size(); i-- > 0;) {
    const bool predicts = i % 2 == 0;
    undo(filter.steps[i], filter.shift, predicts, predicts ? low : high, predicts ? high : low);
  }
  const auto end = [](const Signal& s) {
    return s.origin + static_cast<ptrdiff_t>(s.values.size());
  };
  const ptrdiff_t first = std::min(low.origin, high.origin), last = std::max(end(low), end(high));
  Signal merged{2 * first, std::vector<int64_t>(static_cast<size_t>(2 * (last - first)))};
  for (ptrdiff_t i = first; i < last; ++i) {
    merged.values[static_cast<size_t>(2 * (i - first))] = low.at(i);
    merged.values[static_cast<size_t>(2 * (i - first) + 1)] = high.at(i);
  }
  return merged;
}

/// 256 log2(x), rounded down: squaring doubles the logarithm, whose bits come off one by one.
int log2Fine(uint64_t x) {
  const int whole = static_cast<int>(std::bit_width(x)) - 1;
  uint64_t mantissa = whole > 31 ? x >> (whole - 31) : x << (31 - whole);  // in [2^31, 2^32)
  int result = whole;
  for (int bit = 0; bit < 8; ++bit) {
    mantissa = (mantissa * mantissa) >> 31;
    const bool carry = mantissa >> 32;
    result = 2 * result + carry;
    mantissa >>= carry;
  }
  return result;
}

/// 256 log2 of the norm of a unit coefficient of the low or high band after `splits` splits.
int measure(const WaveletSpec& spec, bool high, int splits) {
  Signal signal{0, {kImpulse}};
  for (int level = splits; level >= 1; --level) {
    const bool first = high && level == splits;
    signal = merge(spec.filter(level), first ? Signal{} : signal, first ? signal : Signal{});
  }
  uint64_t energy = 0;  // at most 2^10 samples of about 2^40
  for (int64_t value : signal.values) energy += static_cast<uint64_t>(value * value);
  constexpr int kImpulseLog = 2 * 20 * 256;
  return (log2Fine(energy) - kImpulseLog) >> 1;
}

}  // namespace

SynthesisNorms::SynthesisNorms(const WaveletSpec& spec, int levels) : spec_(spec) {
  for (int i = 1; i <= levels; ++i) {
    const auto at = static_cast<size_t>(i);
    const bool measured = i <= kMeasuredLevels;
    low_[at] = measured ? measure(spec, false, i) : 2 * low_[at - 1] - low_[at - 2];
    high_[at] = measured ? measure(spec, true, i) : 2 * high_[at - 1] - high_[at - 2];
  }
}

int SynthesisNorms::fine(const Subband& band) const {
  int norm = (band.isHighX() ? high_ : low_)[static_cast<size_t>(band.splits_x)] +
             (band.isHighY() ? high_ : low_)[static_cast<size_t>(band.splits_y)];
  // A detail band is made from the low band of the level before, LL is itself a low band.
  const int doubled_up_to = band.orientation == Orientation::kLL ? band.level : band.level - 1;
  for (int level = 1; level <= doubled_up_to; ++level)
    norm -= spec_.doubles(level) ? kFineSteps : 0;
  return norm;
}

double SynthesisNorms::energy(const Subband& band) const {
  return portable::exp2(2.0 * fine(band) / kFineSteps);
}

}  // namespace tetrakis::inline wavelet
