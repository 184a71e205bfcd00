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
#pragma once

#include <cstdint>
#include <span>

#include "codec/levels.hpp"

namespace tetrakis {

/// In place, row by row: heights to coefficients (each at its own vertex). values: width * height,
/// |height| < 2^27. Exactly undone by inverseLifting.
void forwardLifting(std::span<int32_t> values, uint32_t width, uint32_t height);

/// Coefficients to heights. Defined for all values: arithmetic wraps modulo 2^32.
void inverseLifting(std::span<int32_t> values, uint32_t width, uint32_t height);

}  // namespace tetrakis
