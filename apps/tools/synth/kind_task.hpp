// SPDX-License-Identifier: Apache-2.0
// KindTask is the input of every kind of terrain, and Storage says how its samples are stored.
#pragma once

#include <algorithm>
#include <cstdint>

#include "apps/tools/synth/noise.hpp"
#include "apps/tools/synth/relief.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::tools::synth {

/// The mountains that a kind changes.
struct KindTask {
  Relief& relief;
  uint32_t size;
  uint64_t seed;

  /// A place in samples, from the terrain's north-western corner.
  Point samples(uint32_t x, uint32_t y) const {
    return {static_cast<double>(x) - relief.margin, static_cast<double>(y) - relief.margin};
  }
  double summit() const { return *std::max_element(relief.height.begin(), relief.height.end()); }
};

/// How the heights of a kind are stored.
struct Storage {
  tks_sample sample = TKS_U16;  ///< or TKS_F32, in metres
  double step = kHeightStep;    ///< metres of one unit of an integer
  Raster<uint8_t> voids;        ///< 1: no height; no raster: none
};

}  // namespace tetrakis::tools::synth
