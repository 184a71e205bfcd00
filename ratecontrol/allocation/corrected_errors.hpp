// SPDX-License-Identifier: Apache-2.0
// correctedErrors() takes the errors that a model gives for all pairs of prefixes and corrects them
// by the measured errors of some pairs. The error of the model is a factor that changes slowly from
// pair to pair, so that it suffices to measure every other prefix of either component.
#pragma once

#include <cstddef>
#include <vector>

namespace tetrakis::inline allocation {

/// The places of the prefixes to measure among `prefixes` prefixes, at least one: every other one
/// and the last; and at the end the place of the original, which is behind them.
std::vector<size_t> measuredPlaces(size_t prefixes);

/// Errors of the pictures of all pairs, in the order that PairErrors takes.
struct ErrorGrid {
  size_t heights = 0, textures = 0;  ///< prefixes of either, without the original
  std::vector<double> errors;
};

/// measured: errors of the pairs at measuredPlaces() of either component. Between these places the
/// logarithm of the quotient of measured and modelled errors is linear; at them the result is the
/// measured error, unless the model sees no error there.
std::vector<double> correctedErrors(const ErrorGrid& modelled, const std::vector<double>& measured);

}  // namespace tetrakis::inline allocation
