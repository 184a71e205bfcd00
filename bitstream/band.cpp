// SPDX-License-Identifier: Apache-2.0
#include "bitstream/band.hpp"

namespace tetrakis {

Neighbours neighboursOf(const BandShape& shape, uint32_t row) {
  const auto stride = static_cast<ptrdiff_t>(shape.stride());
  if (!shape.staggered) {
    return {{-1, 1, -stride, stride}, {-stride - 1, stride + 1, -stride + 1, stride - 1}};
  }
  const ptrdiff_t west = row % 2 == 0 ? 0 : -1;  // column step towards the row above or below
  return {{-stride + west, stride + west + 1, -stride + west + 1, stride + west},
          {-1, 1, -2 * stride, 2 * stride}};
}

Band::Band(const BandShape& band_shape)
    : shape(band_shape),
      block_columns((shape.stride() - 2 + kBlockColumns - 1) / kBlockColumns),
      magnitude(shape.cells(), 0),
      sign(shape.cells(), 0),
      plane(shape.cells(), kUnknown),
      block_nonzero(size_t{(shape.rows + kBlockRows - 1) / kBlockRows} * block_columns, 0) {}

}  // namespace tetrakis
