// SPDX-License-Identifier: Apache-2.0
// Reference decoder: bands of coefficients and the codeword that fills them (docs/FORMAT.md,
// sections 4 to 6).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tetrakis::reference {

struct Coefficient {
  uint32_t magnitude = 0;
  int sign = 0;    ///< -1, 0 (insignificant), 1
  int plane = 32;  ///< the bits from here upwards are known

  /// FORMAT 6, "Value".
  int32_t value() const;
};

/// FORMAT 5. Rows of columns[0] and columns[1] coefficients in turn.
struct Band {
  Band(int rowCount, int evenColumns, int oddColumns, bool isStaggered);

  bool empty() const;
  int columnsOf(int r) const { return columns[r % 2]; }
  int widest() const { return std::max(columns[0], columns[1]); }
  int blockRows() const { return (rows + 7) / 8; }
  int blockColumns() const { return (widest() + 31) / 32; }
  Coefficient& at(int r, int a);
  /// The coefficient in row r, column a; outside the band one that is insignificant.
  Coefficient get(int r, int a) const;
  /// Whether the block holds a significant coefficient; outside the band none does.
  bool blockMarked(int row, int column) const;

  int rows;
  std::array<int, 2> columns;
  bool staggered;
  int logNorm = 0;
  int modelClass = 0;
  /// The hint for row r, column a, from the bands of the track; none: 0.
  std::function<uint32_t(const std::vector<Band>&, int r, int a)> hint;
  std::vector<Coefficient> coefficients;  ///< rows of widest()
  bool marked = false;                    ///< holds a significant coefficient
  std::vector<bool> blocks;               ///< likewise each block, row by row
};

/// Runs all passes over the bands. Returns whether every decision counted (FORMAT 4, tail rule).
bool decodeTrack(std::span<const uint8_t> codeword, int planes, std::vector<Band>& bands);

}  // namespace tetrakis::reference
