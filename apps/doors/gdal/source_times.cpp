// SPDX-License-Identifier: Apache-2.0
// The times that the bands of a source say.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <optional>

#include <cpl_conv.h>
#include <cpl_string.h>
#include "apps/doors/gdal/frame_times.hpp"

namespace tetrakis::gdal {
namespace {

constexpr char kOfNetcdf[] = "NETCDF_DIM_", kOfGrib[] = "GRIB_VALID_TIME";

/// Numbers of the bands, and what a whole one means.
struct Numbers {
  SequenceClock clock;
  std::vector<double> values;
};

/// One item of each band; nothing if one lacks it.
std::optional<std::vector<double>> itemsOf(GDALDataset& dataset, const std::string& key) {
  std::vector<double> values;
  for (auto&& band : dataset.GetBands()) {
    const char* const text = band->GetMetadataItem(key.c_str());
    if (text == nullptr) return std::nullopt;
    values.push_back(CPLAtof(text));  // of GRIB "1551398400 sec UTC"
  }
  return values;
}

/// Of the dimension whose units are those of a time.
std::optional<Numbers> ofNetcdf(GDALDataset& dataset) {
  CSLConstList items = dataset.GetRasterBand(1)->GetMetadata();
  for (int i = 0; i < CSLCount(items); ++i) {
    if (!STARTS_WITH(items[i], kOfNetcdf)) continue;
    const std::string key = std::string(items[i]).substr(0, std::string(items[i]).find('='));
    const std::string dimension = key.substr(sizeof kOfNetcdf - 1);
    const char* const units = dataset.GetMetadataItem((dimension + "#units").c_str());
    const char* const calendar = dataset.GetMetadataItem((dimension + "#calendar").c_str());
    const auto clock =
        clockOfCf(units != nullptr ? units : "", calendar != nullptr ? calendar : "");
    const auto values = itemsOf(dataset, key);
    if (clock && values) return Numbers{*clock, *values};
  }
  return std::nullopt;
}

std::optional<Numbers> ofGrib(GDALDataset& dataset) {
  const auto values = itemsOf(dataset, kOfGrib);
  if (!values) return std::nullopt;
  return Numbers{{1, 1, "1970-01-01T00:00:00Z", ""}, *values};
}

bool isWhole(double value) {
  return value == std::floor(value) && std::abs(value) < 9e15;
}

/// Ticks are as long as the unit, or a part of it that all times are multiples of, to a
/// microsecond.
BandTimes ticksOf(const Numbers& numbers) {
  BandTimes times{numbers.clock, {}};
  const bool whole = std::all_of(numbers.values.begin(), numbers.values.end(), isWhole);
  const double unit =
      static_cast<double>(numbers.clock.numerator) / static_cast<double>(numbers.clock.denominator);
  int64_t common = 0;
  for (const double value : numbers.values) {
    const double scaled = whole ? value : value * unit * 1e6;
    if (!(std::abs(scaled) < 9e18)) return {};
    times.ticks.push_back(std::llround(scaled));
    common = std::gcd(common, times.ticks.back());
  }
  if (whole || common == 0) return times;
  for (int64_t& tick : times.ticks) tick /= common;
  const auto part = std::gcd<uint64_t>(static_cast<uint64_t>(common), 1'000'000);
  times.clock.numerator = static_cast<uint64_t>(common) / part;
  times.clock.denominator = 1'000'000 / part;
  return times;
}

}  // namespace

BandTimes timesOf(const std::string& name, GDALDataset& dataset) {
  std::optional<Numbers> numbers = ofNetcdf(dataset);
  if (!numbers) numbers = ofGrib(dataset);
  BandTimes times;
  if (numbers) times = ticksOf(*numbers);
  const auto falls =
      std::adjacent_find(times.ticks.begin(), times.ticks.end(), std::greater_equal<int64_t>());
  if (!times.ticks.empty() && falls == times.ticks.end()) return times;
  if (numbers)
    CPLError(CE_Warning, CPLE_AppDefined,
             "%s: The times of the bands do not rise, and are left out.", name.c_str());
  times = {};
  times.ticks.resize(static_cast<size_t>(dataset.GetRasterCount()));
  std::iota(times.ticks.begin(), times.ticks.end(), 0);
  return times;
}

}  // namespace tetrakis::gdal
