// SPDX-License-Identifier: Apache-2.0
// A drawing has a list of the values of its vertices (colours, or heights in steps), in the order
// in which they first appear. Encoder and decoder both build it; a vertex has the index of its
// value.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tetrakis::inline drawing {

/// Place of a value in the list; the vertices that nothing is known of have kNoIndex.
using DrawnIndex = uint16_t;

inline constexpr int kDrawnIndexBits = 12;
inline constexpr size_t kMostDrawnValues = size_t{1} << kDrawnIndexBits;
inline constexpr DrawnIndex kNoIndex = 0xffff;

/// An index as planes keep it: kNoIndex where nothing was written to zeroed memory, which then need
/// not even be there.
class KeptIndex {
 public:
  KeptIndex() = default;
  KeptIndex& operator=(DrawnIndex index) {
    complement_ = static_cast<DrawnIndex>(~index);
    return *this;
  }
  operator DrawnIndex() const { return static_cast<DrawnIndex>(~complement_); }

 private:
  DrawnIndex complement_;
};

}  // namespace tetrakis::inline drawing
