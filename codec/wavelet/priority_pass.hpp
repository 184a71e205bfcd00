// SPDX-License-Identifier: Apache-2.0
// PriorityPass codes a priority map, tile by tile. It asks whether a tile has the priority that its
// neighbours predict (the median of the western one, the northern one and the plane through both:
// M. J. Weinberger et al., "LOCO-I", 1996), and else how far above or below the priority is.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "bitstream/coder/adaptive_bit.hpp"
#include "bitstream/track/band.hpp"

namespace tetrakis::inline wavelet {

/// Io: bitstream/coder/decision_decoding.hpp, decision_encoding.hpp.
template <class Io>
class PriorityPass {
 public:
  explicit PriorityPass(Io& io) : io_(io) {}

  /// priorities: of the encoder the map, of the decoder as many zeros, which it fills up to the
  /// first decision that does not count.
  void run(uint32_t columns, std::span<uint8_t> priorities) {
    for (size_t i = 0; i < priorities.size(); ++i) {
      const int priority = tile(expect(columns, priorities, i), priorities[i]);
      if (io_.stopped()) return;
      priorities[i] = static_cast<uint8_t>(priority);
    }
  }

 private:
  static constexpr int kHighest = int{kPriorities} - 1;
  static constexpr size_t kBusy = 3;  ///< how much the neighbours differ

  struct Expected {
    int priority;
    size_t busy;
  };

  static Expected expect(uint32_t columns, std::span<const uint8_t> priorities, size_t i) {
    const bool has_west = i % columns > 0, has_north = i >= columns;
    int west = has_west ? priorities[i - 1] : 0;
    int north = has_north ? priorities[i - columns] : west;
    if (!has_west) west = north;
    const int beyond = has_west && has_north ? priorities[i - columns - 1] : north;
    const int slope = west + north - beyond;
    const int least = std::min(west, north), most = std::max(west, north);
    const auto differ = static_cast<size_t>(std::abs(west - beyond) + std::abs(north - beyond));
    return {std::clamp(slope, least, most), std::min(differ, kBusy - 1)};
  }

  /// wanted: of the encoder the priority.
  int tile(const Expected& expected, int wanted) {
    const auto& [priority, busy] = expected;
    if (io_.decide(same_[busy], wanted == priority) || io_.stopped()) return priority;
    const bool either = priority > 0 && priority < kHighest;
    const bool up = either ? io_.decide(up_[busy], wanted > priority) : priority == 0;
    const int room = up ? kHighest - priority : priority;
    int off = 1;
    while (off < room &&
           io_.decide(more_[static_cast<size_t>(off)], std::abs(wanted - priority) > off))
      ++off;
    return up ? priority + off : priority - off;
  }

  Io& io_;
  std::array<AdaptiveBit, kBusy> same_, up_;
  std::array<AdaptiveBit, kPriorities> more_;
};

}  // namespace tetrakis::inline wavelet
