// SPDX-License-Identifier: Apache-2.0
// What lies where a raster of the whole Earth ends: its first column beside the last one.
#pragma once

#include <cmath>
#include <cstdint>

#include "apps/tools/files/place/raster_place.hpp"

namespace tetrakis::tools {

/// The columns that go once round the Earth, at equal longitudes: all of a raster, or all but a
/// last one that is the first again. 0: the raster does not go round.
uint32_t columnsRound(const RasterPlace& place, uint32_t width, uint32_t height);

/// Two samples along a row or a column, and what share the second one has in a place between them.
struct SamplesBeside {
  uint32_t first, second;
  double share;
};

/// at: 0 is the middle of the first of `count` samples. Places beyond the outer ones are theirs.
SamplesBeside samplesBeside(double at, uint32_t count);

/// The same where the first sample comes again at `period` <= count, behind the last.
SamplesBeside samplesRound(double at, uint32_t count, double period);

}  // namespace tetrakis::tools
