// SPDX-License-Identifier: Apache-2.0
// Which samples of a height file are void.
#include "apps/tools/files/void_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "apps/tools/files/sample_types.hpp"
#include "apps/tools/files/text.hpp"
#include "base/nodata.hpp"
#include "base/samples.hpp"

namespace tetrakis::tools {
namespace {

template <class T>
std::optional<double> asInteger(double nodata) {
  using Limits = std::numeric_limits<T>;
  const bool fits = nodata >= double{Limits::min()} && nodata <= double{Limits::max()} &&
                    nodata == std::trunc(nodata);
  return fits ? std::optional(nodata) : std::nullopt;
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

/// How many samples a nodata value would name.
uint64_t countOf(double value, const HeightFile& heights) {
  return visitSamples(heights, [value](auto samples) {
    return static_cast<uint64_t>(
        std::count_if(samples.begin(), samples.end(), [value](auto sample) {
          if constexpr (std::is_floating_point_v<decltype(sample)>)
            return meetsNodata(sample, floatNodata(value));
          else
            return static_cast<double>(sample) == value;
        }));
  });
}

std::string textOf(double value, tks_sample sample) {
  return sample == TKS_F32 ? shortest(static_cast<float>(value)) : shortest(value);
}

}  // namespace

std::optional<double> asSample(double nodata, tks_sample sample) {
  return withSampleType(sample, [nodata]<class T>(T) {
    if constexpr (std::is_integral_v<T>) return asInteger<T>(nodata);
    return std::optional(double{floatNodata(nodata)});
  });
}

void matchNodata(HeightFile& heights) {
  if (heights.sample != TKS_F32 || !heights.nodata) return;
  const float nodata = floatNodata(*heights.nodata);
  heights.nodata = nodata;
  const std::span samples(reinterpret_cast<float*>(heights.data.data()),
                          heights.data.size() / sizeof(float));
  for (float& sample : samples)
    if (!std::isnan(sample) && sample != nodata && meetsNodata(sample, nodata)) sample = nodata;
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

uint64_t nansBesideNodata(const HeightFile& heights) {
  if (heights.sample != TKS_F32 || !heights.nodata || std::isnan(*heights.nodata)) return 0;
  return visitSamples(heights, [](auto samples) {
    return static_cast<uint64_t>(std::count_if(samples.begin(), samples.end(), [](auto sample) {
      return std::isnan(static_cast<double>(sample));
    }));
  });
}

std::optional<Note> takeOutliers(HeightFile& heights) {
  tks_outliers found{sizeof found, 0, 0, 0};
  const tks_heights described = asHeights(heights);
  if (tks_find_outliers(&described, &found) != TKS_OK || found.count == 0) return std::nullopt;
  const std::string value = textOf(found.value, heights.sample);
  const bool alone = countOf(found.value, heights) == found.count;
  if (found.is_fill != 0 && !heights.nodata) {
    heights.nodata = found.value;
    return Note{counted(found.count, "sample is ", "samples are ") + value +
                    ", far from all others: taken as void (--nodata nan keeps heights)",
                "--nodata"};
  }
  const std::string beside =
      heights.nodata ? " and from its nodata value " + textOf(*heights.nodata, heights.sample) : "";
  const std::string far = counted(found.count, "sample lies", "samples lie") +
                          " far from all others" + beside +
                          (alone ? ", at " : ", the farthest at ") + value;
  const bool sayable = alone && (!heights.nodata || countOf(*heights.nodata, heights) == 0);
  return Note{far + (sayable ? ": if void, give --nodata " + value
                             : ": if they are void, only a mask can say so"),
              "--nodata"};
}

}  // namespace tetrakis::tools
