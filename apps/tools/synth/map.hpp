// SPDX-License-Identifier: Apache-2.0
// drawMap() draws the sample terrain as a cartographer does.
#pragma once

#include "apps/tools/files/files.hpp"
#include "apps/tools/synth/rivers.hpp"

namespace tetrakis::tools::synth {

/// RGB8 of 2 (size - 1) texels a side over the terrain without its margin: a tint for each belt of
/// heights, contour lines, water, houses. Twelve colours at most, every edge sharp.
ImageFile drawMap(const Relief& relief, const Rivers& rivers, uint32_t size);

}  // namespace tetrakis::tools::synth
