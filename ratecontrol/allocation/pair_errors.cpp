// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/allocation/pair_errors.hpp"

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

}  // namespace tetrakis::inline allocation
