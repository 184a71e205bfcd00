// SPDX-License-Identifier: Apache-2.0
// Other kinds of terrain, made of the mountains.
#pragma once

#include "tools/synth/synth.hpp"
#include "tools/synth/synth_relief.hpp"

namespace tetrakis::tools::synth {

/// How the heights of a kind are stored.
struct Storage {
  tks_sample sample = TKS_U16;  ///< or TKS_F32, in metres
  double step = kHeightStep;    ///< metres of one unit of an integer
  Raster<uint8_t> voids;        ///< 1: no height; no raster: none
};

/// Turns the mountains of `size` into another kind, and says how to store it.
Storage reshape(Relief& relief, SynthKind kind, uint32_t size, uint64_t seed);

}  // namespace tetrakis::tools::synth
