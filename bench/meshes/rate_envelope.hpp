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
  double bytes = 0;
};

/// Codings that differ in one setting alone, in its order: there are settings between them.
using ErrorCurve = std::vector<ErrorPoint>;

/// The least bytes of all curves at an error. Between neighbours of a curve bytes follow straight
/// lines of the logarithms; and what errs less serves as well. Nothing where no curve passes.
std::optional<double> bytesAt(const std::vector<ErrorCurve>& curves, double error);

}  // namespace tetrakis::bench
