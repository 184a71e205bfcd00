// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/allocation/corrected_errors.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/portable_math.hpp"

namespace tetrakis::inline allocation {

namespace {

/// The place of a prefix among the measured ones.
struct Between {
  size_t before, after;
  double rest;  ///< of the way to the one after
};

Between betweenMeasured(const std::vector<size_t>& measured, size_t place) {
  const auto after = std::lower_bound(measured.begin(), measured.end(), place);
  assert(after != measured.end());
  const auto i = static_cast<size_t>(after - measured.begin());
  if (*after == place) return {i, i, 0};
  const auto way = static_cast<double>(measured[i] - measured[i - 1]);
  return {i - 1, i, static_cast<double>(place - measured[i - 1]) / way};
}

}  // namespace

std::vector<size_t> measuredPlaces(size_t prefixes) {
  assert(prefixes > 0);
  std::vector<size_t> places;
  for (size_t i = 0; i + 1 < prefixes; i += 2) places.push_back(i);
  places.push_back(prefixes - 1);
  places.push_back(prefixes);
  return places;
}

std::vector<double> correctedErrors(const ErrorGrid& modelled,
                                    const std::vector<double>& measured) {
  const size_t width = modelled.textures + 1;
  const std::vector<size_t> rows = measuredPlaces(modelled.heights);
  const std::vector<size_t> columns = measuredPlaces(modelled.textures);
  assert(measured.size() == rows.size() * columns.size());
  std::vector<double> factors;  // their logarithms, at the measured pairs
  for (const size_t row : rows) {
    for (const size_t column : columns) {
      const double model = modelled.errors[row * width + column];
      const double truth = measured[factors.size()];
      factors.push_back(model > 0 && truth > 0 ? portable::log(truth / model) : 0);
    }
  }
  std::vector<double> errors;
  for (size_t row = 0; row <= modelled.heights; ++row) {
    const Between y = betweenMeasured(rows, row);
    for (size_t column = 0; column < width; ++column) {
      const Between x = betweenMeasured(columns, column);
      const auto along = [&](size_t of) {
        const double* const factor = &factors[of * columns.size()];
        return std::lerp(factor[x.before], factor[x.after], x.rest);
      };
      const double factor = std::lerp(along(y.before), along(y.after), y.rest);
      errors.push_back(modelled.errors[row * width + column] * portable::exp(factor));
    }
  }
  return errors;
}

}  // namespace tetrakis::inline allocation
