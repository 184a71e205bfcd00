// SPDX-License-Identifier: Apache-2.0
// rangesOf() turns chosen pieces into byte ranges to ask for, and joins neighbours.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "ratecontrol/receiver/piece_choice.hpp"

namespace tetrakis::inline receiver {

/// Bytes to fetch, and what one of the first of them takes off the error of the picture beside
/// other ranges; 0: nothing in this view.
struct FetchRange {
  uint64_t begin = 0, end = 0;
  double gain = 0;
};

/// A range, and the best place among the pieces of the plan that are in it.
struct RankedRange {
  FetchRange range;
  uint32_t rank = 0;

  void join(const RankedRange& next) {
    range.end = next.range.end;
    range.gain = std::max(range.gain, next.range.gain);
    rank = std::min(rank, next.rank);
  }
};

/// Ranges that help go on over bytes that do not, where a request costs more than these. The most
/// helpful come first.
std::vector<FetchRange> rangesOf(std::span<const Piece> pieces, std::span<const uint32_t> order,
                                 const Choice& chosen, uint64_t request_bytes);

}  // namespace tetrakis::inline receiver
