// SPDX-License-Identifier: Apache-2.0
// Reference decoder: bands of coefficients and the codeword that fills them (docs/FORMAT.md,
// sections 4 to 6).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tetrakis::reference {

enum Orientation { kLL, kHL, kLH, kHH };

struct Coefficient {
  uint32_t magnitude = 0;
  int sign = 0;   ///< -1, 0 (insignificant), 1
  int plane = 0;  ///< the bits from here upwards are known
  int priority = 0;
  bool absent = false;
};

/// FORMAT 5, table of neighbours.
struct Neighbours {
  Coefficient along[2], across[2], far[4];
};

struct Band {
  Band(int rowCount, int columnCount, Orientation direction);

  /// Whether no coefficient exists.
  bool empty() const;
  /// How many coefficients of a priority do.
  uint32_t existing(int priority) const;
  int blockRows() const { return (rows + 7) / 8; }
  int blockColumns() const { return (columns + 31) / 32; }
  Coefficient& at(int r, int a);
  /// The coefficient in row r, column a; outside the band one that is insignificant.
  Coefficient get(int r, int a) const;
  Neighbours neighboursOf(int r, int a) const;
  /// Whether the block holds a significant coefficient of any priority; outside the band none does.
  bool blockMarked(int row, int column) const;
  /// FORMAT 6, "Value", in units of 2^-e.
  int32_t value(int r, int a, int e) const;

  static constexpr size_t kNone = SIZE_MAX;

  int rows, columns;
  Orientation orientation;
  int logNorm = 0, modelClass = 0;
  std::optional<int> leastKey;
  size_t parent = kNone, companion = kNone;  ///< numbers of bands of the track
  std::vector<size_t> siblings;              ///< likewise
  std::vector<Coefficient> coefficients;     ///< row by row
  bool needed = true;                        ///< its passes have to be decoded (FORMAT 7.1)
  std::array<bool, 8> marked = {};           ///< holds a significant one of a priority
  std::vector<std::array<bool, 8>> blocks;   ///< likewise each block, row by row
};

/// Runs the passes over the bands, up to the last one of a needed band or to the first decision
/// that does not count (FORMAT 4, tail rule).
void decodeTrack(std::span<const uint8_t> codeword, int planes, std::vector<Band>& bands);

}  // namespace tetrakis::reference
