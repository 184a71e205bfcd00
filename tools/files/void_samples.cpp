// SPDX-License-Identifier: Apache-2.0
// Which samples of a height file are void.
#include "tools/files/void_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "tools/files/sample_types.hpp"
#include "tools/files/text.hpp"

namespace tetrakis::tools {
namespace {

template <class T>
std::optional<double> asInteger(double nodata) {
  using Limits = std::numeric_limits<T>;
  const bool fits = nodata >= double{Limits::min()} && nodata <= double{Limits::max()} &&
                    nodata == std::trunc(nodata);
  return fits ? std::optional(nodata) : std::nullopt;
}

std::optional<double> asFloat(double nodata) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  if (std::isfinite(nodata) && std::abs(nodata) > kLargest) {
    const double largest = std::copysign(kLargest, nodata);
    return meetsNodata(nodata, largest) ? std::optional(largest) : std::nullopt;
  }
  return static_cast<double>(static_cast<float>(nodata));
}

/// The outermost value that no valid sample has, of the 65536 at the end of the type's range where
/// heights are least likely.
template <class T>
std::optional<double> freeValue(std::span<const T> samples, const std::vector<uint8_t>& mask) {
  using Limits = std::numeric_limits<T>;
  const auto rank = [](T value) {
    return std::is_signed_v<T> ? static_cast<uint64_t>(int64_t{value} - Limits::min())
                               : static_cast<uint64_t>(Limits::max() - value);
  };
  const uint64_t range = rank(std::is_signed_v<T> ? Limits::max() : Limits::min()) + 1;
  std::vector<bool> taken(std::min<uint64_t>(range, 65536));
  for (size_t i = 0; i < samples.size(); ++i) {
    if (mask[i] != 0 && rank(samples[i]) < taken.size()) taken[rank(samples[i])] = true;
  }
  const auto free =
      static_cast<double>(std::find(taken.begin(), taken.end(), false) - taken.begin());
  if (free == static_cast<double>(taken.size())) return std::nullopt;
  return std::is_signed_v<T> ? double{Limits::min()} + free : double{Limits::max()} - free;
}

std::string textOf(double value, tks_sample sample) {
  return sample == TKS_F32 ? shortest(static_cast<float>(value)) : shortest(value);
}

struct Outliers {
  uint64_t count = 0, others = 0;
  double value = 0;   ///< the outermost
  double range = 0;   ///< of the others
  bool equal = true;  ///< all outliers have that value
};

/// Finite floats that no height in any unit can be.
Outliers hugeFloats(std::span<const float> samples) {
  constexpr float kHuge = 1e30F;
  Outliers found;
  for (const float sample : samples) {
    if (!std::isfinite(sample)) continue;
    if (std::abs(sample) <= kHuge) {
      ++found.others;
      continue;
    }
    found.equal = found.equal && (found.count == 0 || double{sample} == found.value);
    ++found.count;
    if (std::abs(sample) > std::abs(found.value)) found.value = sample;
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
    // 0 is a height of its own.
    if (std::is_signed_v<T> && low.count > 0) return low;
    const Outliers high = isolatedEnd(samples, std::numeric_limits<T>::max());
    return high.count > 0 ? high : isolatedExtreme(samples);
  }
}

}  // namespace

float toFloat(double value) {
  // A conversion that overflows is undefined.
  if (std::abs(value) <= double{std::numeric_limits<float>::max()} || !std::isfinite(value))
    return static_cast<float>(value);
  return std::copysign(std::numeric_limits<float>::infinity(), value < 0 ? -1.0F : 1.0F);
}

bool meetsNodata(double sample, double nodata) {
  if (std::isnan(nodata)) return std::isnan(sample);
  constexpr double kRelative = 2.0 * std::numeric_limits<float>::epsilon();
  constexpr double kLargest = std::numeric_limits<float>::max();
  // GDAL adds floats: a sum that overflows is larger than any difference.
  const bool overflows = std::abs(sample) <= kLargest && std::abs(nodata) <= kLargest &&
                         std::isinf(static_cast<float>(sample) + static_cast<float>(nodata));
  return sample == nodata || overflows ||
         std::abs(sample - nodata) < kRelative * std::abs(sample + nodata);
}

std::optional<double> asSample(double nodata, tks_sample sample) {
  switch (sample) {
    case TKS_U8:
      return asInteger<uint8_t>(nodata);
    case TKS_I8:
      return asInteger<int8_t>(nodata);
    case TKS_U16:
      return asInteger<uint16_t>(nodata);
    case TKS_I16:
      return asInteger<int16_t>(nodata);
    case TKS_U32:
      return asInteger<uint32_t>(nodata);
    case TKS_I32:
      return asInteger<int32_t>(nodata);
    case TKS_F32:
      break;
  }
  return asFloat(nodata);
}

void matchNodata(HeightFile& heights) {
  if (heights.sample != TKS_F32 || !heights.nodata) return;
  const auto nodata = static_cast<float>(*heights.nodata);
  visitSamples(heights, [nodata](auto samples) {
    for (auto& sample : samples) {
      const auto value = static_cast<double>(sample);
      if (value != double{nodata} && !std::isnan(nodata) && meetsNodata(value, double{nodata}))
        sample = static_cast<std::remove_reference_t<decltype(sample)>>(nodata);
    }
  });
}

Status applyMask(HeightFile& heights, const std::vector<uint8_t>& mask, Notes& notes) {
  if (std::find(mask.begin(), mask.end(), 0) == mask.end()) return {};
  std::optional<double> value =
      heights.nodata ? asSample(*heights.nodata, heights.sample) : std::nullopt;
  if (!value) {
    value = visitSamples(std::as_const(heights), [&mask](auto samples) {
      using T = std::remove_cvref_t<decltype(samples[0])>;
      if constexpr (std::is_integral_v<T>) return freeValue<T>(samples, mask);
      return std::optional(std::numeric_limits<double>::quiet_NaN());
    });
    if (!value) {
      return {TKS_USAGE,
              "its mask needs a nodata value and its samples take all: convert it to 32 "
              "bits"};
    }
    heights.nodata = value;
    if (heights.sample != TKS_F32)
      notes.push_back(
          {"its mask is read as the nodata value " + textOf(*value, heights.sample), ""});
  }
  visitSamples(heights, [&mask, &value](auto samples) {
    using T = std::remove_reference_t<decltype(samples[0])>;
    for (size_t i = 0; i < samples.size(); ++i)
      if (mask[i] == 0) samples[i] = static_cast<T>(*value);
  });
  return {};
}

std::optional<Note> noteOnNodata(const HeightFile& heights) {
  if (!heights.nodata || heights.sample == TKS_F32) return {};
  if (asSample(*heights.nodata, heights.sample)) return {};
  return Note{"no sample of its type can have the nodata value " + shortest(*heights.nodata) +
                  ", which makes nothing void",
              ""};
}

std::optional<Note> takeHugeAsVoid(HeightFile& heights) {
  if (heights.nodata || heights.sample != TKS_F32) return std::nullopt;
  const Outliers found = visitSamples(std::as_const(heights), [](auto samples) {
    using T = std::remove_cvref_t<decltype(samples[0])>;
    if constexpr (std::is_same_v<T, float>) return hugeFloats(samples);
    return Outliers{};
  });
  if (found.count == 0 || found.others == 0 || !found.equal) return std::nullopt;
  heights.nodata = found.value;
  return Note{counted(found.count, "sample is ", "samples are ") +
                  textOf(found.value, heights.sample) + ", which no height is: taken as void",
              "--nodata"};
}

std::optional<Note> noteOnOutliers(const HeightFile& heights) {
  if (heights.nodata) return std::nullopt;
  const Outliers found = visitSamples(heights, [](auto samples) { return outliersOf(samples); });
  if (found.count == 0 || found.others == 0) return std::nullopt;
  const std::string value = textOf(found.value, heights.sample);
  return Note{counted(found.count, "sample lies", "samples lie") + " far from all others, at " +
                  value + ": if void, give --nodata " + value,
              "--nodata"};
}

}  // namespace tetrakis::tools
