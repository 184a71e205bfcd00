// SPDX-License-Identifier: Apache-2.0
// DrawnSteps is the list of the values of drawn heights, in steps. Both sides build it, and code a
// value that it lacks as a difference from the neighbours' values.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "codec/drawing/drawing_index.hpp"
#include "codec/drawing/drawing_neighbours.hpp"
#include "codec/drawing/drawing_residual.hpp"

namespace tetrakis::inline drawn_heights {

class DrawnSteps {
 public:
  size_t size() const { return steps_.size(); }
  /// The class of the difference between two steps: 17 if they are equal, less if a is the lower
  /// one. Differences of up to 5 steps have a class each.
  uint32_t difference(DrawnIndex a, DrawnIndex b) const {
    const int64_t higher = int64_t{steps_[a]} - steps_[b];
    const uint64_t steps = static_cast<uint64_t>(higher < 0 ? -higher : higher);
    const uint32_t kind = steps < 6
                              ? static_cast<uint32_t>(steps)
                              : std::min(3 + static_cast<uint32_t>(std::bit_width(steps)), 16u);
    return higher < 0 ? 17 - kind : 17 + kind;
  }

  int32_t operator[](DrawnIndex i) const { return steps_[i]; }

  /// Codes a step that the list lacks as its difference from the mean of the first two candidates,
  /// modulo 2^32.
  template <class Io>
  void code(const Candidates& around, size_t vertex, Io& io) {
    uint32_t expected = 0;
    if (around.count() > 0) {
      const int64_t a = steps_[around[0].index];
      const int64_t b = steps_[around[std::min(around.count() - 1, 1)].index];
      expected = static_cast<uint32_t>((a + b) >> 1);
    }
    const uint32_t ours = static_cast<uint32_t>(io.value(vertex)) - expected;
    const auto residual =
        static_cast<uint32_t>(codeResidual(residuals_, static_cast<int32_t>(ours), io));
    if (!io.stopped()) steps_.push_back(static_cast<int32_t>(expected + residual));
  }

 private:
  std::vector<int32_t> steps_;
  ResidualModels<32> residuals_;
};

}  // namespace tetrakis::inline drawn_heights
