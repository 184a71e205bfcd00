// SPDX-License-Identifier: Apache-2.0
// What is known of one band of transform coefficients while its bit-planes arrive.
//
// A band is a rectangular array, or a quincunx one whose odd rows are shifted by half a column:
//
//   rectangular            quincunx (even row a at x = 2a + 1, odd row a at x = 2a)
//     NW  N  NE               N2
//      W  .  E             NW    NE        near: NW NE SW SE (distance 1)
//     SW  S  SE           W   .    E       far:  W E N2 S2   (distance sqrt 2)
//   near: W E N S          SW    SE
//   far:  the diagonals       S2
//
// Structure of arrays with a margin of zeros, so that neighbours need no bounds checks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetrakis {

struct BandShape {
  uint32_t rows = 0;
  std::array<uint32_t, 2> columns{};  ///< in even and in odd rows
  bool staggered = false;             ///< quincunx rows

  uint32_t stride() const { return (columns[0] > columns[1] ? columns[0] : columns[1]) + 2; }
  size_t cells() const { return size_t{rows + 4} * stride(); }
  size_t cell(uint32_t row, uint32_t column) const {
    return size_t{row + 2} * stride() + column + 1;
  }
  bool empty() const { return rows == 0 || (columns[0] == 0 && (rows == 1 || columns[1] == 0)); }
};

/// Cell offsets of a coefficient's neighbours. near[0..1] and near[2..3] are opposite pairs.
struct Neighbours {
  std::array<ptrdiff_t, 4> near;
  std::array<ptrdiff_t, 4> far;
};

Neighbours neighboursOf(const BandShape& shape, uint32_t row);

struct Band {
  static constexpr uint32_t kBlockRows = 8, kBlockColumns = 32;
  static constexpr uint8_t kUnknown = 32;  ///< plane of a coefficient nothing is known of

  explicit Band(const BandShape& band_shape);

  /// Coefficient at a cell: the middle of its known interval, 0 while insignificant.
  int32_t value(size_t cell) const {
    return sign[cell] * static_cast<int32_t>(middle(magnitude[cell], plane[cell]));
  }

  /// Reconstruction point of a magnitude known down to bit-plane `known`. A little below the
  /// middle, because densities fall; exact at plane 0.
  static uint32_t middle(uint32_t magnitude, int known) {
    return magnitude == 0 ? 0 : magnitude + (((uint32_t{1} << known) * 7) >> 4);
  }

  BandShape shape;
  uint32_t block_columns;              ///< blocks in a row of blocks
  std::vector<uint32_t> magnitude;     ///< known bits, unknown ones zero
  std::vector<int8_t> sign;            ///< -1, 0 while insignificant, 1
  std::vector<uint8_t> plane;          ///< lowest known bit-plane of each coefficient
  std::vector<uint8_t> block_nonzero;  ///< the block holds a significant coefficient
  bool nonzero = false;                ///< the band holds a significant coefficient
};

}  // namespace tetrakis
