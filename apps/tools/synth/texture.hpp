// SPDX-License-Identifier: Apache-2.0
// photograph() makes the aerial photograph of the sample terrain.
#pragma once

#include "apps/tools/files/files.hpp"
#include "apps/tools/synth/rivers.hpp"

namespace tetrakis::tools::synth {

/// RGB8, 2 (size - 1) texels a side, north up, sun in the north-west.
ImageFile photograph(const Relief& relief, const Rivers& rivers, uint32_t size, uint64_t seed);

}  // namespace tetrakis::tools::synth
