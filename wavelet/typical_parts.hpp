// SPDX-License-Identifier: Apache-2.0
// Where a plane is looked at before it is coded. Encoder only.
#pragma once

#include <cstdint>
#include <vector>

namespace tetrakis {

/// A rectangle of a plane, in samples.
struct Part {
  uint32_t x, y, width, height;
};

/// The parts that stand for a plane of width * height samples, none of them 0, where trying all of
/// it would take too long. One part if neither side is above 256. Otherwise one in the middle of
/// each field of a grid of 3 by 3, of `side` samples at most along each side: one part alone may be
/// water, or a lawn.
std::vector<Part> typicalParts(uint32_t width, uint32_t height, uint32_t side = 96);

}  // namespace tetrakis
