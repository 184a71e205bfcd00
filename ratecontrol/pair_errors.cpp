// SPDX-License-Identifier: Apache-2.0
#include "ratecontrol/pair_errors.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace tetrakis::inline ratecontrol {

namespace {

double between(const PairErrors::Place& place, double from, double to) {
  if (place.rest == 0) return from;
  if (place.last || from <= 0 || to <= 0) return from + (to - from) * place.rest;
  return from * std::pow(to / from, place.rest);
}

}  // namespace

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
  if (next == nodes.end()) return {node, 1 - square / nodes[node], true};
  return {node, std::log(nodes[node] / square) / std::log(nodes[node] / *next), false};
}

double PairErrors::at(const Place& heights, const Place& texture) const {
  const size_t columns = nodes_.textures.size() + 1;
  const auto along = [&](size_t row) {
    const double* errors = &errors_[row * columns + texture.node];
    return between(texture, errors[0], texture.rest == 0 ? 0 : errors[1]);
  };
  const double from = along(heights.node);
  return heights.rest == 0 ? from : between(heights, from, along(heights.node + 1));
}

}  // namespace tetrakis::inline ratecontrol
