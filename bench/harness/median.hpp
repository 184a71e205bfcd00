// SPDX-License-Identifier: Apache-2.0
// The median of what several runs took.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tetrakis::bench {

/// The upper one of two. values: one or more.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace tetrakis::bench
