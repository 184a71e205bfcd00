// SPDX-License-Identifier: Apache-2.0
// PairErrors interpolates the errors of a grid of pairs, and correctedErrors() corrects those of a
// model by measured ones.
#include "ratecontrol/allocation/allocation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "base/portable_math.hpp"

namespace tetrakis::inline allocation {

namespace {

/// The powers with which errors may fall behind the last prefix that was looked at. A wider range
/// follows the prefixes before it more closely, and errs more where these fell by chance.
constexpr double kLeastPower = 0.5, kMostPower = 2;

/// before, from, to: errors at the node before that of the place, at it, and at the next one.
double between(const PairErrors::Place& place, double before, double from, double to) {
  if (place.rest == 0) return from;
  if (place.last)
    return to + (from - to) * portable::pow(1 - place.rest, place.power(before, from, to));
  if (from <= 0 || to <= 0) return from + (to - from) * place.rest;
  return from * portable::pow(to / from, place.rest);
}

}  // namespace

double PairErrors::Place::power(double before, double from, double to) const {
  if (!(before > from && from > to) || ratio <= 1) return 1;
  return std::clamp(portable::log((before - to) / (from - to)) / portable::log(ratio), kLeastPower,
                    kMostPower);
}

PairErrors::PairErrors(PairNodes nodes, std::vector<double> errors)
    : nodes_(std::move(nodes)), errors_(std::move(errors)) {
  assert(!nodes_.heights.empty() && !nodes_.textures.empty());
  assert(errors_.size() == (nodes_.heights.size() + 1) * (nodes_.textures.size() + 1));
}

PairErrors::Place PairErrors::placeOf(const std::vector<double>& nodes, double square) {
  if (square >= nodes.front()) return {};
  // The last node that is not below.
  const auto next =
      std::find_if(nodes.begin(), nodes.end(), [&](double node) { return node < square; });
  const auto node = static_cast<size_t>(next - nodes.begin()) - 1;
  if (next != nodes.end())
    return {node, portable::log(nodes[node] / square) / portable::log(nodes[node] / *next)};
  // The first node, that of no coefficients, predicts nothing for the others.
  const double ratio = node > 1 ? nodes[node - 1] / nodes[node] : 1;
  return {node, 1 - square / nodes[node], true, ratio};
}

double PairErrors::at(const Place& heights, const Place& texture) const {
  const size_t columns = nodes_.textures.size() + 1;
  const auto along = [&](size_t row) {
    const double* errors = &errors_[row * columns + texture.node];
    const double before = texture.ratio > 1 ? errors[-1] : 0;
    return between(texture, before, errors[0], texture.rest == 0 ? 0 : errors[1]);
  };
  const double from = along(heights.node);
  if (heights.rest == 0) return from;
  const double before = heights.ratio > 1 ? along(heights.node - 1) : 0;
  return between(heights, before, from, along(heights.node + 1));
}

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
