// SPDX-License-Identifier: Apache-2.0
// Adaptive model of one binary decision: the mean of a fast and a slow exponential estimate
// (two-rate counters as in PAQ and VVC's CABAC), both starting with the 1/n rule so that the first
// few symbols already count.
#pragma once

#include <algorithm>
#include <cstdint>

namespace tetrakis {

class AdaptiveBit {
 public:
  static constexpr int kPrecision = 16;   ///< probabilities are multiples of 2^-16
  static constexpr int kFastRate = 5;     ///< final step of the fast estimate: 2^-4
  static constexpr int kSlowRate = 8;     ///< final step of the slow estimate: 2^-7
  static constexpr uint32_t kFloor = 24;  ///< no decision is more certain than 1 - 24/65536

  /// P(bit = 0) in units of 2^-16, in [kFloor, 65536 - kFloor].
  uint32_t zero() const {
    const uint32_t mean = (uint32_t{fast_} + slow_) >> 1;
    return std::clamp(mean, kFloor, (1u << kPrecision) - kFloor);
  }

  void update(bool bit) {
    const int target = bit ? 0 : 0xffff;
    fast_ = static_cast<uint16_t>(fast_ + ((target - fast_) >> std::min<int>(rate_, kFastRate)));
    slow_ = static_cast<uint16_t>(slow_ + ((target - slow_) >> rate_));
    if (++seen_ >= (1 << rate_) && rate_ < kSlowRate) ++rate_;
  }

 private:
  uint16_t fast_ = 0x8000;
  uint16_t slow_ = 0x8000;
  uint8_t rate_ = 1;   ///< current shift of the slow estimate
  uint16_t seen_ = 0;  ///< symbols seen while rate_ still grows (wraps harmlessly afterwards)
};

}  // namespace tetrakis
