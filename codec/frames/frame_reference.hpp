// SPDX-License-Identifier: Apache-2.0
// The frames of a group may go on from the last frame of the group before (FrameReference): then
// plane 0 of each colour, which is about the mean of the group, holds only what differs from it,
// and what stands still takes next to no bytes. A reference is what a stated number of bytes shows,
// which every receiver has, so that all of them add the same (docs/FORMAT.md, section 9.4).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "base/view.hpp"
#include "bitstream/stream/coding_headers.hpp"

namespace tetrakis::inline frames {

/// The values of a decoded plane as whole steps, rounded.
std::vector<int32_t> wholeSteps(std::span<const int32_t> values, int fraction_bits);

/// Gives samples without a value the mean of the nearest values to the left, to the right, above
/// and below, weighted by how near they are; those that meet none, in a second pass. So the ground
/// goes on behind the border of what was seen. valid: 1 for each sample with a value, 0 for the
/// others; empty: all have one. Samples of a plane without any value become 0.
std::vector<int32_t> filledReference(std::vector<int32_t> values, std::vector<uint8_t> valid,
                                     Extent extent);

/// Adds the reference of a colour, at the samples that a view shows, to its plane 0 in units of
/// 2^-fraction_bits.
void addReference(std::span<const int32_t> reference, Extent plane, const View& view,
                  int fraction_bits, std::span<int32_t> values);

/// The same, taken away, for encoders: of a whole plane.
void takeReference(std::span<const int32_t> reference, int fraction_bits,
                   std::span<int32_t> values);

}  // namespace tetrakis::inline frames
