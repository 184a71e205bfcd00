// SPDX-License-Identifier: Apache-2.0
// surfaceOfGlobe() gives the surface of a globe's mesh at the samples that it was made of.
#pragma once

#include <cstdint>
#include <vector>

#include "tetrakis/tetrakis.hpp"

namespace tetrakis::bench {

/// The heights of the mesh of at most so many triangles at the samples of the stream's raster, in
/// the unit: those of a triangle lie on the plane through its corners, over the raster.
Result<std::vector<float>> surfaceOfGlobe(Decoder& decoder, uint32_t triangles);

}  // namespace tetrakis::bench
