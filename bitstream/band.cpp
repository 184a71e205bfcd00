// SPDX-License-Identifier: Apache-2.0
#include "bitstream/band.hpp"

namespace tetrakis {

Band::Band(const BandShape& band_shape, Orientation band_orientation)
    : shape(band_shape),
      orientation(band_orientation),
      magnitude(shape.cells(), 0),
      scaled(shape.cells(), 0),
      sign(shape.cells(), 0),
      significant(shape.wordCells(), 0),
      visited(shape.wordCells(), 0),
      block_nonzero(size_t{blockRows()} * shape.words(), 0) {}

}  // namespace tetrakis
