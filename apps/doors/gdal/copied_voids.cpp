// SPDX-License-Identifier: Apache-2.0
#include "apps/doors/gdal/copied_voids.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "apps/doors/gdal/source.hpp"
#include "base/nodata.hpp"

namespace tetrakis::gdal {
namespace {

template <class Visitor>
auto visit(tks_sample type, std::span<std::byte> samples, const Visitor& visitor) {
  const auto as = [&]<class T>(T) {
    return visitor(std::span(reinterpret_cast<T*>(samples.data()), samples.size() / sizeof(T)));
  };
  switch (type) {
    case TKS_U8:
      return as(uint8_t{});
    case TKS_I8:
      return as(int8_t{});
    case TKS_U16:
      return as(uint16_t{});
    case TKS_I16:
      return as(int16_t{});
    case TKS_U32:
      return as(uint32_t{});
    case TKS_I32:
      return as(int32_t{});
    case TKS_F32:
      break;
  }
  return as(float{});
}

/// Of floats NaN. The outermost value that no valid sample has, of the 65536 at the end of the
/// type's range where heights are least likely.
template <class T>
std::optional<double> freeValue(std::span<T> samples, const std::vector<GByte>& mask) {
  using Limits = std::numeric_limits<T>;
  if constexpr (!std::is_integral_v<T>) {
    return Limits::quiet_NaN();
  } else {
    const auto rank = [](T value) {
      return std::is_signed_v<T> ? static_cast<uint64_t>(int64_t{value} - int64_t{Limits::min()})
                                 : static_cast<uint64_t>(Limits::max() - value);
    };
    const uint64_t range = rank(std::is_signed_v<T> ? Limits::max() : Limits::min()) + 1;
    std::vector<bool> taken(std::min<uint64_t>(range, 65536));
    for (size_t i = 0; i < samples.size(); ++i)
      if (mask[i] != 0 && rank(samples[i]) < taken.size()) taken[rank(samples[i])] = true;
    const auto found = std::find(taken.begin(), taken.end(), false);
    if (found == taken.end()) return std::nullopt;
    const auto free = static_cast<double>(found - taken.begin());
    return std::is_signed_v<T> ? double{Limits::min()} + free : double{Limits::max()} - free;
  }
}

template <class T>
bool holds(double value) {
  if constexpr (!std::is_integral_v<T>) return true;
  return value == std::trunc(value) && value >= double(std::numeric_limits<T>::min()) &&
         value <= double(std::numeric_limits<T>::max());
}

std::span<float> floatsOf(CopiedHeights& copy) {
  return {reinterpret_cast<float*>(copy.samples.data()), copy.samples.size() / sizeof(float)};
}

/// The shortest decimal that reads back as this value.
template <class T>
std::string textOf(T value) {
  if (std::isnan(value)) return "NaN";
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

void warn(const std::string& name, const std::string& sentence) {
  CPLError(CE_Warning, CPLE_AppDefined, "%s: %s.", name.c_str(), sentence.c_str());
}

}  // namespace

std::optional<double> nodataOf(GDALRasterBand& band) {
  int has_nodata = FALSE;
  const double nodata = band.GetNoDataValue(&has_nodata);
  return has_nodata ? std::optional(nodata) : std::nullopt;
}

bool hasMask(GDALRasterBand& band) {
  return (band.GetMaskFlags() & (GMF_ALL_VALID | GMF_NODATA)) == 0;
}

bool canHaveNodata(const tks_heights& heights) {
  return heights.has_nodata &&
         visit(heights.sample, {}, [&]<class T>(std::span<T>) { return holds<T>(heights.nodata); });
}

void hide(tks_sample type, std::span<std::byte> samples, std::span<const GByte> mask,
          double value) {
  visit(type, samples, [&]<class T>(std::span<T> values) {
    for (size_t i = 0; i < values.size(); ++i)
      if (mask[i] == 0) values[i] = static_cast<T>(value);
  });
}

void settleNodata(std::span<float> samples, double nodata) {
  const auto value = static_cast<float>(nodata);
  for (float& sample : samples)
    if (!std::isnan(sample) && meetsNodata(sample, value)) sample = value;
}

void takeNodata(const std::string& name, GDALRasterBand& band, CopiedHeights& copy) {
  const std::optional<double> nodata = nodataOf(band);
  if (!nodata) return;
  tks_heights& heights = copy.heights;
  if (heights.sample != TKS_F32) {
    heights.has_nodata = 1;
    heights.nodata = *nodata;
    if (!canHaveNodata(heights))
      warn(name, "No sample of its type can have the nodata value " + textOf(*nodata) +
                     ", which makes nothing void");
  } else if (!heights.has_nodata) {
    const float value = floatNodata(*nodata);
    heights.nodata = value;
    settleNodata(floatsOf(copy), value);
  }
  heights.has_nodata = 1;
  if (band.GetRasterDataType() == GDT_Float64 && !meetsNodata(*nodata, heights.nodata))
    warn(name, "Floats of 32 bits do not hold its nodata value " + textOf(*nodata) +
                   ", for which " + textOf(static_cast<float>(heights.nodata)) + " stands");
}

bool applyMask(const std::string& name, GDALRasterBand& band, CopiedHeights& copy) {
  if (!hasMask(band)) return true;
  const int width = band.GetXSize(), height = band.GetYSize();
  std::vector<GByte> mask(size_t(width) * size_t(height));
  if (band.GetMaskBand()->RasterIO(GF_Read, 0, 0, width, height, mask.data(), width, height,
                                   GDT_Byte, 0, 0, nullptr) != CE_None)
    return false;
  if (std::find(mask.begin(), mask.end(), 0) == mask.end()) return true;
  tks_heights& heights = copy.heights;
  std::optional<double> value;
  if (canHaveNodata(heights)) {
    value = heights.nodata;
  } else {
    value = visit(heights.sample, copy.samples,
                  [&]<class T>(std::span<T> samples) { return freeValue(samples, mask); });
  }
  if (!value) {
    reportFailure(TKS_USAGE, name,
                  "The mask needs a nodata value, and the samples take all of "
                  "them; convert them to a wider type.");
    return false;
  }
  hide(heights.sample, copy.samples, mask, *value);
  heights.has_nodata = 1;
  heights.nodata = *value;
  return true;
}

void takeFill(const std::string& name, bool strict, CopiedHeights& copy) {
  tks_heights& heights = copy.heights;
  tks_outliers found{sizeof found, 0, 0, 0};
  if (tks_find_outliers(&heights, &found) != TKS_OK || found.count == 0) return;
  const bool floats = heights.sample == TKS_F32;
  const std::string value = floats ? textOf(static_cast<float>(found.value)) : textOf(found.value);
  const std::string count = std::to_string(found.count);
  if (found.is_fill == 0 || heights.has_nodata || strict) {
    warn(name, count + " samples lie far from all others" +
                   (heights.has_nodata ? " and from its nodata value" : "") + ", the farthest at " +
                   value + ": if void, declare them (gdal_translate -a_nodata " + value + ")");
    return;
  }
  heights.has_nodata = 1;
  heights.nodata = found.value;
  warn(name, count + " samples are " + value +
                 ", far from all others: declared as nodata (not by a strict copy)");
}

std::optional<double> fillIn(const tks_heights& part) {
  tks_outliers found{sizeof found, 0, 0, 0};
  if (part.has_nodata || tks_find_outliers(&part, &found) != TKS_OK || !found.is_fill)
    return std::nullopt;
  return found.value;
}

void declareFill(const std::string& name, bool strict, double fill, CopiedHeights& copy) {
  const bool floats = copy.heights.sample == TKS_F32;
  const std::string value = floats ? textOf(static_cast<float>(fill)) : textOf(fill);
  if (strict) {
    warn(name, "Samples are " + value + ", far from all others: if void, declare them" +
                   " (gdal_translate -a_nodata " + value + ")");
    return;
  }
  copy.heights.has_nodata = 1;
  copy.heights.nodata = fill;
  warn(name,
       "Samples are " + value + ", far from all others: declared as nodata (not by a strict copy)");
}

}  // namespace tetrakis::gdal
