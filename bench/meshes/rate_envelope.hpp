// SPDX-License-Identifier: Apache-2.0
// The lower envelope of many codings of one thing: what a user who tries all settings pays for an
// error.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace tetrakis::bench {

struct ErrorPoint {
  double error = 0;  ///< above 0
  double cost = 0;   ///< bytes, or triangles
};

/// Codings that differ in one setting alone, in its order: there are settings between them.
using ErrorCurve = std::vector<ErrorPoint>;

/// The least cost of all curves at an error. Between neighbours of a curve costs follow straight
/// lines of the logarithms; and what errs less serves as well. Nothing where no curve passes.
std::optional<double> costAt(const std::vector<ErrorCurve>& curves, double error);

/// The same, and where no curve reaches so large an error, the least cost of what errs less.
/// Nothing where all err more.
std::optional<double> leastAt(const std::vector<ErrorCurve>& curves, double error);

}  // namespace tetrakis::bench
