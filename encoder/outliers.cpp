// SPDX-License-Identifier: Apache-2.0
#include "encoder/encode_stream.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "base/nodata.hpp"
#include "base/samples.hpp"

namespace tetrakis::inline encoder {

namespace {

/// Floats beyond this size are no heights, if there are others. A larger number overlooks voids;
/// with a smaller one data in tiny units would count as voids.
constexpr double kHuge = 1e30;
/// A single outlying value of this size or more is a void that files fill in. A larger number
/// leaves more of these values for the user to judge; a smaller one takes heights for voids.
constexpr double kNoHeight = 1e10;
/// The least numbers of 16 and 32 bits, which files write where they have no height.
constexpr std::array kFillValues = {-32768.0, -32767.0, -2147483648.0};

/// Whether a value is one that files write where they have no height: rows of nines below zero, the
/// least numbers of 16 bits and of 32, in any type, and numbers too large for a height.
bool isFill(double value) {
  if (std::abs(value) >= kNoHeight ||
      std::find(kFillValues.begin(), kFillValues.end(), value) != kFillValues.end())
    return true;
  double nines = -999;
  while (nines > value) nines = 10 * nines - 9;
  return nines == value;
}

struct Outliers {
  uint64_t count = 0;
  double value = 0;   ///< the outermost
  bool equal = true;  ///< all outliers have that value
};

/// Calls f with all samples that are neither NaN nor infinite nor the declared nodata value.
template <class F>
void forEachHeight(const tks_heights& heights, const F& f) {
  withSampleType(heights.sample, [&]<class T>(T) {
    const bool whole = std::is_integral_v<T>;
    const double nodata = whole ? heights.nodata : double{toFloat(heights.nodata)};
    const size_t count = size_t{heights.width} * heights.height;
    for (const T sample : std::span(static_cast<const T*>(heights.data), count)) {
      const auto value = static_cast<double>(sample);
      if (std::isfinite(value) && (heights.has_nodata == 0 || value != nodata)) f(value);
    }
  });
}

/// Finite floats that no height in any unit can be, unless there are no others.
Outliers hugeFloats(const tks_heights& heights) {
  Outliers found;
  uint64_t others = 0;
  forEachHeight(heights, [&](double value) {
    if (std::abs(value) <= kHuge) {
      ++others;
      return;
    }
    found.equal = found.equal && (found.count == 0 || value == found.value);
    ++found.count;
    if (std::abs(value) > std::abs(found.value)) found.value = value;
  });
  return others > 0 ? found : Outliers{};
}

/// Finite samples without those of one value.
struct Others {
  uint64_t left_out = 0;  ///< samples of that value
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
};

/// The finite samples that differ from `value`; NaN leaves none out.
Others othersThan(double value, const tks_heights& heights) {
  Others others;
  forEachHeight(heights, [&](double other) {
    if (other == value) {
      ++others.left_out;
    } else {
      others.low = std::min(others.low, other);
      others.high = std::max(others.high, other);
    }
  });
  return others;
}

/// Whether a single sample of this value is no height: the ends of an integer type.
bool isEndOfType(double value, tks_sample sample) {
  return withSampleType(sample, [value]<class T>(T) {
    using Limits = std::numeric_limits<T>;
    return Limits::is_integer && (value == double(Limits::min()) || value == double(Limits::max()));
  });
}

/// The samples of value `end`, the least or the greatest of all, if the gap to the others is wider
/// than the range of these.
Outliers isolated(double end, const tks_heights& heights) {
  const Others others = othersThan(end, heights);
  const double range = others.high - others.low;
  const double gap = std::max(others.low - end, end - others.high);
  const bool enough = others.left_out > 1 || isEndOfType(end, heights.sample);
  const bool found = range > 0 && gap > range && enough;  // two values make no terrain with voids
  return found ? Outliers{others.left_out, end} : Outliers{};
}

Outliers outliersOf(const tks_heights& heights) {
  if (tks_sample_bytes(heights.sample) == 1) return {};  // classes and masks hold the ends
  if (heights.sample == TKS_F32) {
    const Outliers huge = hugeFloats(heights);
    if (huge.count > 0) return huge;
  }
  const Others all = othersThan(std::numeric_limits<double>::quiet_NaN(), heights);
  const Outliers low = isolated(all.low, heights);
  return low.count > 0 ? low : isolated(all.high, heights);
}

}  // namespace

tks_outliers findOutliers(const tks_heights& heights) {
  tks_outliers out{sizeof out, 0, 0, 0};
  const Outliers found = outliersOf(heights);
  if (found.count == 0) return out;
  out.count = found.count;
  out.value = found.value;
  out.is_fill = found.equal && isFill(found.value);
  return out;
}

}  // namespace tetrakis::inline encoder
