// SPDX-License-Identifier: Apache-2.0
#include "bitstream/band.hpp"

namespace tetrakis {

Band::Band(const BandShape& band_shape, Orientation band_orientation)
    : shape(band_shape),
      orientation(band_orientation),
      magnitude(shape.cells()),
      scaled(shape.cells()),
      sign(shape.cells()),
      significant(shape.wordCells()),
      visited(shape.wordCells()),
      block_nonzero(size_t{blockRows()} * shape.words()) {}

}  // namespace tetrakis
