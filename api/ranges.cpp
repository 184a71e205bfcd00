// SPDX-License-Identifier: Apache-2.0
#include "api/ranges.hpp"

#include <algorithm>

namespace tetrakis::inline api {

void giveRanges(std::span<const tks_range> ranges, tks_ranges& out) {
  if (ranges.empty()) return;
  out.ranges = new tks_range[ranges.size()];
  out.count = ranges.size();
  std::copy(ranges.begin(), ranges.end(), out.ranges);
}

}  // namespace tetrakis::inline api

void tks_free_ranges(tks_ranges* ranges) {
  if (ranges == nullptr) return;
  delete[] ranges->ranges;
  *ranges = {};
}
