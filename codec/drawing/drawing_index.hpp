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

}  // namespace tetrakis::inline drawing
