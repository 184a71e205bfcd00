// SPDX-License-Identifier: Apache-2.0
// The probabilities of a drawn texture's decisions.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitstream/adaptive_bit.hpp"
#include "texture_wavelet/drawn_neighbours.hpp"

namespace tetrakis {

/// Models of a decision about an index, from the most special to the most general: of both first
/// candidates, of the first, of none. The first one that has seen a decision is asked; all learn.
struct IndexModels {
  AdaptiveBit *pair, *single, *plain;

  AdaptiveBit& asked() const { return pair->fresh() ? single->fresh() ? *plain : *single : *pair; }
};

class DrawnModels {
 public:
  static constexpr size_t kClasses = 17;  ///< of a channel's residual: bits of its magnitude

  DrawnModels()
      : pairs_(size_t{1} << kPairBits),
        singles_(size_t{1} << kSingleBits),
        plain_(size_t{1} << kColourIndexBits) {}

  /// Whether the vertex has the colour of the candidate at `place`.
  AdaptiveBit& candidate(const Candidates& around, int place, LevelKind kind) {
    const Candidate& c = around[place];
    const int more = place == 0   ? (around.count() > 1 ? std::min(around[1].near, 3) : 0)
                     : place == 1 ? std::min(around.count(), 4) - 1
                                  : 0;
    const int context = (((place * 4 + more) * 5 + c.near) * 3 + c.causal) * 9 + c.ring;
    return candidates_[static_cast<size_t>(2 * context + (kind == LevelKind::kCentres))];
  }

  /// node: 1 followed by the bits of the index so far, the highest first.
  IndexModels index(const Candidates& around, uint32_t node) {
    const uint32_t first = around.count() > 0 ? around[0].colour : kMostColours;
    const uint32_t second = around.count() > 1 ? around[1].colour : kMostColours;
    const auto hash = [&](uint32_t context, int bits) {
      return ((context * kFactor + node) * 2654435761u) >> (32 - bits);
    };
    return {&pairs_[hash(first * kFactor + second, kPairBits)], &singles_[hash(first, kSingleBits)],
            &plain_[node]};
  }

  AdaptiveBit fresh;  ///< the colour has not appeared before
  std::array<std::array<AdaptiveBit, kClasses>, 4> residual;  ///< [channel]: its class exceeds ...

 private:
  static constexpr uint32_t kFactor = kMostColours + 3;
  static constexpr int kPairBits = 18, kSingleBits = 16;

  std::array<AdaptiveBit, 2 * Candidates::kRanked * 4 * 5 * 3 * 9> candidates_;
  std::vector<AdaptiveBit> pairs_, singles_, plain_;
};

}  // namespace tetrakis
