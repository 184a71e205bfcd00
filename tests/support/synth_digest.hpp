// SPDX-License-Identifier: Apache-2.0
// A number for a synthesised terrain: equal numbers, equal bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "apps/tools/synth/synth.hpp"

namespace tetrakis::test {

/// FNV-1a, 64 bits, of heights, texture and map.
inline uint64_t digest(const tools::SynthTerrain& terrain) {
  uint64_t h = 0xcbf29ce484222325u;
  for (const std::vector<std::byte>* data :
       {&terrain.heights.data, &terrain.texture.data, &terrain.map.data})
    for (const std::byte b : *data) h = (h ^ static_cast<uint64_t>(b)) * 0x100000001b3u;
  return h;
}

}  // namespace tetrakis::test
