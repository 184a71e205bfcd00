// SPDX-License-Identifier: Apache-2.0
// How soon the first bytes of a stream are a mesh on the screen.
#pragma once

#include <cstddef>
#include <cstdint>

#include "bench/peers/raster.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::bench {

inline constexpr size_t kFirstBytes = 2048, kMoreBytes = 65536;
inline constexpr uint32_t kFirstTriangles = 3000;

/// Milliseconds of processor time, medians.
struct FirstMeshTimes {
  double first_ms = 0;     ///< from kFirstBytes to a mesh of kFirstTriangles, opening included
  double more_ms = 0;      ///< likewise from kMoreBytes, all of the stream
  double openjpeg_ms = 0;  ///< all samples of a 9/7 codestream of 1 bit a sample
};

/// Of heights, on one thread, alternating.
Result<FirstMeshTimes> timeFirstMesh(const Raster& raster, int runs);

}  // namespace tetrakis::bench
