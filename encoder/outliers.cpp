// SPDX-License-Identifier: Apache-2.0
#include "encoder/outliers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "base/samples.hpp"

namespace tetrakis::inline encoder {

namespace {

constexpr double kHuge = 1e30;  // no height in any unit is as large

/// What files write where they have no height: rows of nines below zero, the least numbers of 16
/// bits and the least of 32, whatever type holds them, and floats too large for a height.
bool isFill(double value) {
  constexpr std::array kLeast = {-32768.0, -32767.0, -2147483648.0};
  if (std::abs(value) > kHuge || std::find(kLeast.begin(), kLeast.end(), value) != kLeast.end())
    return true;
  double nines = -999;
  while (nines > value) nines = 10 * nines - 9;
  return nines == value;
}

struct Outliers {
  uint64_t count = 0, others = 0;
  double value = 0;   ///< the outermost
  double range = 0;   ///< of the others
  bool equal = true;  ///< all outliers have that value
};

/// Finite floats that no height in any unit can be.
Outliers hugeFloats(std::span<const float> samples) {
  Outliers found;
  for (const float sample : samples) {
    if (!std::isfinite(sample)) continue;
    if (std::abs(double{sample}) <= kHuge) {
      ++found.others;
      continue;
    }
    found.equal = found.equal && (found.count == 0 || double{sample} == found.value);
    ++found.count;
    if (std::abs(double{sample}) > std::abs(found.value)) found.value = double{sample};
  }
  return found;
}

/// The samples of value `end`, which has no others on one side, where the gap to those on the other
/// is wider than their range.
template <class T>
Outliers isolatedEnd(std::span<const T> samples, T end) {
  using Limits = std::numeric_limits<T>;
  Outliers found{0, 0, static_cast<double>(end)};
  T low = Limits::max(), high = Limits::lowest();
  for (const T sample : samples) {
    if (sample == end) {
      ++found.count;
      continue;
    }
    if (!std::isfinite(static_cast<double>(sample))) continue;
    ++found.others;
    low = std::min(low, sample);
    high = std::max(high, sample);
  }
  found.range = double(high) - double(low);
  const double gap = std::max(double(low) - double(end), double(end) - double(high));
  return found.others > 0 && gap > found.range ? found : Outliers{};
}

/// The least or the greatest value, where it repeats, as -9999 does, and the others vary: two
/// values make no terrain with voids. 0 is a height of its own.
template <class T>
Outliers isolatedExtreme(std::span<const T> samples) {
  T least = std::numeric_limits<T>::max(), greatest = std::numeric_limits<T>::lowest();
  for (const T sample : samples) {
    if (!std::isfinite(static_cast<double>(sample))) continue;
    least = std::min(least, sample);
    greatest = std::max(greatest, sample);
  }
  for (const T extreme : {least, greatest}) {
    const Outliers found = isolatedEnd(samples, extreme);
    if (found.count > 1 && found.range > 0 && extreme != 0) return found;
  }
  return {};
}

template <class T>
Outliers outliersOf(std::span<const T> samples) {
  if constexpr (std::is_floating_point_v<T>) {
    const Outliers huge = hugeFloats(samples);
    return huge.count > 0 ? huge : isolatedExtreme(samples);
  } else if constexpr (sizeof(T) == 1) {
    return {};  // classes and masks hold the ends of so small a type
  } else {
    const Outliers low = isolatedEnd(samples, std::numeric_limits<T>::min());
    if (std::is_signed_v<T> && low.count > 0) return low;  // else 0, a height of its own
    const Outliers high = isolatedEnd(samples, std::numeric_limits<T>::max());
    return high.count > 0 ? high : isolatedExtreme(samples);
  }
}

}  // namespace

tks_outliers findOutliers(const tks_heights& heights) {
  tks_outliers out{sizeof out, 0, 0, 0};
  if (heights.has_nodata != 0) return out;
  const Outliers found = withSampleType(heights.sample, [&heights]<class T>(T) {
    const size_t count = size_t{heights.width} * heights.height;
    return outliersOf(std::span(static_cast<const T*>(heights.data), count));
  });
  if (found.count == 0 || found.others == 0) return out;
  out.count = found.count;
  out.value = found.value;
  out.is_fill = found.equal && isFill(found.value);
  return out;
}

}  // namespace tetrakis::inline encoder
