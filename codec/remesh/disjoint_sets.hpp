// SPDX-License-Identifier: Apache-2.0
// DisjointSets joins numbers into sets, each of which is named by its lowest number.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tetrakis::inline remesh {

class DisjointSets {
 public:
  explicit DisjointSets(size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  /// The lowest number of the set that holds `number`.
  uint32_t find(uint32_t number) {
    while (parent_[number] != number) number = parent_[number] = parent_[parent_[number]];
    return number;
  }

  void join(uint32_t a, uint32_t b) {
    const auto [low, high] = std::minmax({find(a), find(b)});
    parent_[high] = low;
  }

 private:
  std::vector<uint32_t> parent_;
};

}  // namespace tetrakis::inline remesh
