// SPDX-License-Identifier: Apache-2.0
// Reversible integer lifting of order 6 on the quincunx lattices of the 4-8 connection
// (J. Kovacevic, W. Sweldens, "Wavelet families of increasing order in arbitrary dimensions",
// 2000).
//
// Each level inserts the vertices of one coset of a quincunx lattice. In units of the distance to
// the nearest neighbours the Neville filter of order 6 has the taps
//
//   distance   1     sqrt 5    3    sqrt 13
//   vertices   4       8       4       8
//   weight    174     -27      2       3      / 512
//
//   predict   d = x_new - round(sum w x_old / 512)
//   update    x_old += round(sum w d / 1024)
//
// Boundary rule: a neighbour outside the grid is replaced by its mirror image across the vertex
// (per axis); if that is outside too it is left out, and predict divides by the sum of the weights
// left.
//
// Voids: void vertices take part in nothing. In a grid that has any, a neighbour that is void is
// replaced by the opposite one (mirrored likewise) and left out if that is void too; where one is
// left out predict takes the mean of the nearest ring of neighbours that has anyone. (Dividing by
// the sum of the weights would amplify, because some are negative; measured 0.5 % more bytes on
// jagged coasts. Coding filled voids instead takes 1 to 20 % more.)
#pragma once

#include <cstdint>
#include <span>

#include "codec/levels.hpp"

namespace tetrakis {

/// What a transform works on, in place: width * height values, row by row, and which of them
/// exist. Values of void vertices are neither read nor written.
struct LiftedGrid {
  std::span<int32_t> values;
  uint32_t width = 0, height = 0;
  std::span<const uint8_t> valid = {};  ///< 1 valid, 0 void; empty: all are valid
};

/// Heights to coefficients (each at its own vertex). |height| < 2^27. Exactly undone by
/// inverseLifting.
void forwardLifting(const LiftedGrid& grid);

/// Coefficients to heights. Defined for all values: arithmetic wraps modulo 2^32.
void inverseLifting(const LiftedGrid& grid);

/// The same without voids.
inline void forwardLifting(std::span<int32_t> values, uint32_t width, uint32_t height) {
  forwardLifting({values, width, height});
}
inline void inverseLifting(std::span<int32_t> values, uint32_t width, uint32_t height) {
  inverseLifting({values, width, height});
}

}  // namespace tetrakis
