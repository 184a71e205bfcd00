// SPDX-License-Identifier: Apache-2.0
// Sample terrain: eroded mountains with a lake, a farmed plain and a coast, and its aerial
// photograph and map.
#pragma once

#include <cstdint>

#include "tools/files.hpp"

namespace tetrakis::tools {

struct SynthOptions {
  uint32_t size = 513;  ///< samples along a side, at least 2
  uint64_t seed = 1;
};

/// heights: size x size TKS_U16 in steps of 0.1 m, 30 m apart; the sea is 0 and the lake one level.
/// texture and map: RGB8 of 2 (size - 1) texels a side over the same footprint.
struct SynthTerrain {
  HeightFile heights;
  ImageFile texture, map;
};

/// The same bytes from every compiler and machine with IEEE arithmetic. Needs about 400 bytes of
/// memory a sample while it works.
SynthTerrain synthesize(const SynthOptions& options);

}  // namespace tetrakis::tools
