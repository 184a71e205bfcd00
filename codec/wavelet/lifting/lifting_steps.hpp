// SPDX-License-Identifier: Apache-2.0
// forEachRowStep(), forEachStep() and Halves name the samples that each lifting step reads and
// changes, whether these are values or marks of existence. A signal has two samples or more. It is
// mirrored about its first and its last sample, or it is a ring, whose last sample lies beside its
// first one.
//
// On a ring of n samples both halves have ceil(n / 2) places, and the neighbours of a place are
// counted round it. Where n is odd the last high place holds no sample: steps change nothing there,
// and read the mean of the high places on either side. So constants stay constants in all filters.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "codec/wavelet/lifting/lifting_kernel.hpp"

namespace tetrakis::inline lifting {

/// What lies beyond the ends of a signal.
enum class Ends : uint8_t { kMirrored, kJoined };

/// Where the mirror image of place p lies in a signal of n >= 2 samples.
inline ptrdiff_t mirror(ptrdiff_t p, ptrdiff_t n) {
  if (p >= 0 && p < n) return p;
  const ptrdiff_t period = 2 * (n - 1);
  p = ((p % period) + period) % period;
  return std::min(p, period - p);
}

/// Doubles values of a low band.
inline void doubleValues(std::span<int32_t> values) {
  for (int32_t& v : values) v <<= 1;
}

/// Undoes the doubling of a value of a low band; what is odd is rounded up.
inline int32_t halved(int32_t value) {
  return static_cast<int32_t>(static_cast<uint32_t>(value) + 1) >> 1;
}

inline void halveValues(std::span<int32_t> values) {
  for (int32_t& v : values) v = halved(v);
}

/// Rows of equal length at equal distances.
template <class T>
struct Rows {
  T* first;
  size_t pitch;    ///< from one row to the next, in values
  uint32_t count;  ///< rows
  uint32_t width;  ///< values of a row that take part

  T* row(ptrdiff_t t) const { return first + static_cast<size_t>(mirror(t, count)) * pitch; }

  /// What a step reads that changes row t.
  StepSources<std::remove_const_t<T>> sources(ptrdiff_t t, size_t pairs) const {
    StepSources<std::remove_const_t<T>> sources{};
    for (size_t k = 0; k < pairs; ++k) {
      const auto distance = static_cast<ptrdiff_t>(2 * k + 1);
      sources.before[k] = row(t - distance);
      sources.after[k] = row(t + distance);
    }
    return sources;
  }
};

/// Calls lift(t, step) for all rows that the steps of a filter change. The steps follow each other
/// at a distance of a few rows, so that every row is read from memory once.
template <class Lift>
void forEachRowStep(ptrdiff_t rows, FilterId id, Direction direction, Lift&& lift) {
  // A step may follow when the one before has passed all rows that either of them reaches.
  constexpr auto kLag = static_cast<ptrdiff_t>(2 * kMaxPairs);
  const LiftingFilter filter = liftingFilter(id);
  const auto steps = static_cast<ptrdiff_t>(filter.steps.size());
  for (ptrdiff_t front = 0; front < rows + kLag * (steps - 1); ++front) {
    for (ptrdiff_t s = 0; s < steps; ++s) {
      const ptrdiff_t t = front - kLag * s;
      const ptrdiff_t index = direction == Direction::kAnalysis ? s : steps - 1 - s;
      if (t < 0 || t >= rows || (t + index) % 2 == 0) continue;  // step 0 changes odd rows
      lift(t, filter.steps[static_cast<size_t>(index)]);
    }
  }
}

/// Calls lift(step, predicts) for the steps of a filter, one after the other.
template <class Lift>
void forEachStep(FilterId id, Direction direction, Lift&& lift) {
  const LiftingFilter filter = liftingFilter(id);
  for (size_t i = 0; i < filter.steps.size(); ++i) {
    const size_t index = direction == Direction::kAnalysis ? i : filter.steps.size() - 1 - i;
    lift(filter.steps[index], index % 2 == 0);
  }
}

/// The even and the odd elements of a signal, apart, with room on either side for those that steps
/// read beyond its ends.
template <class T>
class Halves {
 public:
  Halves(uint32_t longest, Ends ends)
      : even_(longest / 2 + 1 + 2 * kMargin), odd_(even_.size()), ends_(ends) {}

  void takeApart(const T* row, uint32_t length) {
    setLength(length);
    T *even = low(), *odd = high();
    for (ptrdiff_t i = 0; i < highs_; ++i) {
      even[i] = row[2 * i];
      odd[i] = row[2 * i + 1];
    }
    if (lows_ > highs_) even[highs_] = row[2 * highs_];
  }
  void putTogether(T* row) {
    const T *even = low(), *odd = high();
    for (ptrdiff_t i = 0; i < highs_; ++i) {
      row[2 * i] = even[i];
      row[2 * i + 1] = odd[i];
    }
    if (lows_ > highs_) row[2 * highs_] = even[highs_];
  }

  /// The low half of a row lies before the high half.
  void copyFrom(const T* row, uint32_t length) {
    setLength(length);
    std::copy_n(row, lows_, low());
    std::copy_n(row + lows_, highs_, high());
  }
  void copyTo(T* row) {
    std::copy_n(low(), lows_, row);
    std::copy_n(high(), highs_, row + lows_);
  }

  /// Room for what a step of a signal of that length reads, and how many values that are.
  std::span<T> room(bool predicts, uint32_t length) {
    setLength(length);
    return {predicts ? low() : high(), static_cast<size_t>(predicts ? lows_ : highs_)};
  }

  /// What a step changes that predicts or updates, and what it reads.
  T* targets(bool predicts) { return predicts ? high() : low(); }
  size_t count(bool predicts) const { return static_cast<size_t>(predicts ? highs_ : lows_); }
  StepSources<T> sources(bool predicts, size_t pairs) {
    // Neither mirrors nor rings turn even positions into odd ones, so each half has its margins
    // from itself.
    const auto margin = static_cast<ptrdiff_t>(pairs);
    ends_ == Ends::kMirrored ? mirrorEnds(predicts, margin) : joinEnds(predicts, margin);
    const ptrdiff_t parity = predicts ? 0 : 1;
    const T* source = predicts ? low() : high();
    StepSources<T> sources{};
    for (size_t k = 0; k < pairs; ++k) {
      const auto distance = static_cast<ptrdiff_t>(k);
      sources.before[k] = source - distance - parity;
      sources.after[k] = source + distance + 1 - parity;
    }
    return sources;
  }

 private:
  static constexpr ptrdiff_t kMargin = kMaxPairs;  // elements beyond either end

  T* low() { return even_.data() + kMargin; }
  T* high() { return odd_.data() + kMargin; }
  void setLength(uint32_t length) {
    highs_ = length / 2;
    lows_ = length - highs_;
  }
  void mirrorEnds(bool predicts, ptrdiff_t margin) {
    T* source = predicts ? low() : high();
    const ptrdiff_t count = predicts ? lows_ : highs_, parity = predicts ? 0 : 1;
    for (ptrdiff_t m = 1; m <= margin; ++m) {
      source[-m] = source[mirror(parity - 2 * m, lows_ + highs_) / 2];
      source[count - 1 + m] = source[mirror(parity + 2 * (count - 1 + m), lows_ + highs_) / 2];
    }
  }
  void joinEnds(bool predicts, ptrdiff_t margin) {
    T* source = predicts ? low() : high();
    // A mark between two marks is set if both are.
    if (!predicts && highs_ < lows_)
      source[highs_] = static_cast<T>((int64_t{source[highs_ - 1]} + source[0]) >> 1);
    for (ptrdiff_t m = 0; m < margin; ++m) {
      source[-1 - m] = source[lows_ - 1 - m % lows_];
      source[lows_ + m] = source[m % lows_];
    }
  }

  std::vector<T> even_, odd_;
  Ends ends_;
  ptrdiff_t lows_ = 0, highs_ = 0;
};

}  // namespace tetrakis::inline lifting
