// SPDX-License-Identifier: Apache-2.0
// Embedded bit-plane coding of one band: the three passes of a plane (after EBCOT, D. Taubman
// 2000), with contexts from local magnitude sums (after F. Auli-Llinas 2011) and from a hint of the
// expected magnitude given by coarser bands or other components. Blocks without a significant
// coefficient cost one decision a plane and no work.
//
//   likely   significance where a neighbour is significant (steepest slope)
//   refine   next bit of every coefficient that was significant before this plane
//   rest     significance everywhere else, empty blocks first asked as a whole
//
// The passes are written once. Io is the encoder's or the decoder's side of a decision:
//   bool magnitudeBit(AdaptiveBit&, size_t cell, int plane)   bit `plane` of the magnitude
//   bool signBit(AdaptiveBit&, size_t cell, bool flip)        negative, xor flip
//   bool blockBit(AdaptiveBit&, const CellRange&, int plane)  a magnitude in the range reaches
//   2^plane bool stopped()                                            the last decision did not
//   count void learned(const Band&, size_t cell, uint32_t magnitude_before, int plane_before)
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "bitstream/adaptive_bit.hpp"
#include "bitstream/band.hpp"

namespace tetrakis {

/// Contexts shared by the bands of one class.
struct BandModels {
  static constexpr int kLocal = 11;  ///< classes of the neighbours' magnitude sum
  static constexpr int kHint = 8;    ///< classes of the hint
  std::array<std::array<AdaptiveBit, kHint>, kLocal> significance;
  std::array<AdaptiveBit, 9> refinement;
  std::array<AdaptiveBit, 5> sign;
  std::array<AdaptiveBit, 5> block;
  AdaptiveBit band;
};

/// Expected magnitudes, four times enlarged, of `count` coefficients of a row.
class HintSource {
 public:
  virtual ~HintSource() = default;
  virtual void fill(uint32_t row, uint32_t column, uint32_t count, uint32_t* hints) const = 0;
};

/// A rectangle of a band: rows [row, row_end), columns [column, column_end) as far as rows reach.
struct CellRange {
  uint32_t row, row_end, column, column_end;
};

enum class PassKind : uint8_t { kLikely = 0, kRefine = 1, kRest = 2 };

template <class Io>
class PlanePass {
 public:
  PlanePass(Band& band, BandModels& models, const HintSource& hints, Io& io)
      : band_(band), models_(models), hints_(hints), io_(io) {}

  /// Codes one pass of bit-plane `plane` (0..30). Returns early once io.stopped().
  void run(PassKind kind, int plane) {
    plane_ = plane;
    if (!band_.nonzero) {
      if (kind != PassKind::kRest || !bandBecomesNonzero()) return;
    }
    const uint32_t block_rows = (band_.shape.rows + Band::kBlockRows - 1) / Band::kBlockRows;
    for (uint32_t y = 0; y < block_rows; ++y) {
      for (uint32_t x = 0; x < band_.block_columns; ++x) {
        block(kind, y, x);
        if (io_.stopped()) return;
      }
    }
  }

 private:
  static constexpr int localClass(uint32_t sum) {
    return sum < 5    ? static_cast<int>(sum)
           : sum < 7  ? 5
           : sum < 10 ? 6
           : sum < 14 ? 7
           : sum < 20 ? 8
           : sum < 30 ? 9
                      : 10;
  }

  bool bandBecomesNonzero() {
    const CellRange all{0, band_.shape.rows, 0, band_.shape.stride() - 2};
    const bool bit = io_.blockBit(models_.band, all, plane_);
    band_.nonzero = bit && !io_.stopped();
    return band_.nonzero;
  }

  void block(PassKind kind, uint32_t y, uint32_t x) {
    uint8_t& nonzero = band_.block_nonzero[size_t{y} * band_.block_columns + x];
    const CellRange range{y * Band::kBlockRows,
                          std::min((y + 1) * Band::kBlockRows, band_.shape.rows),
                          x * Band::kBlockColumns, (x + 1) * Band::kBlockColumns};
    if (!nonzero) {
      if (kind != PassKind::kRest) return;
      const bool bit = band_.block_nonzero.size() == 1 ||
                       io_.blockBit(models_.block[blockContext(y, x)], range, plane_);
      if (!bit || io_.stopped()) return;
      nonzero = 1;
    }
    for (uint32_t row = range.row; row < range.row_end && !io_.stopped(); ++row) {
      const uint32_t end = std::min(range.column_end, band_.shape.columns[row % 2]);
      if (range.column >= end) continue;
      switch (kind) {
        case PassKind::kLikely:
          significanceRow<true>(row, range.column, end);
          break;
        case PassKind::kRefine:
          refinementRow(row, range.column, end);
          break;
        case PassKind::kRest:
          significanceRow<false>(row, range.column, end);
          break;
      }
    }
  }

  int blockContext(uint32_t y, uint32_t x) const {
    const uint32_t columns = band_.block_columns;
    const auto at = [&](uint32_t by, uint32_t bx) -> int {
      const size_t i = size_t{by} * columns + bx;
      return bx < columns && i < band_.block_nonzero.size() ? band_.block_nonzero[i] : 0;
    };
    return at(y - 1, x) + at(y + 1, x) + at(y, x - 1) + at(y, x + 1);
  }

  /// 2 (near) + 1 (far) weighted sum of the neighbours' known magnitudes, in units of 2^plane.
  uint32_t localSum(size_t cell, const Neighbours& n) const {
    const uint32_t* m = band_.magnitude.data() + cell;
    const uint32_t near = (m[n.near[0]] >> plane_) + (m[n.near[1]] >> plane_) +
                          (m[n.near[2]] >> plane_) + (m[n.near[3]] >> plane_);
    const uint32_t far = (m[n.far[0]] >> plane_) + (m[n.far[1]] >> plane_) +
                         (m[n.far[2]] >> plane_) + (m[n.far[3]] >> plane_);
    return 2 * near + far;
  }

  template <bool kLikelyOnly>
  void significanceRow(uint32_t row, uint32_t column, uint32_t end) {
    std::array<uint32_t, Band::kBlockColumns> hints;
    hints_.fill(row, column, end - column, hints.data());
    const Neighbours n = neighboursOf(band_.shape, row);
    const size_t first = band_.shape.cell(row, column);
    for (size_t cell = first; cell < first + (end - column); ++cell) {
      if (band_.magnitude[cell] != 0 || band_.plane[cell] <= plane_) continue;
      const int local = localClass(localSum(cell, n));
      if (kLikelyOnly && local == 0) continue;
      const int hint =
          std::min<int>(std::bit_width(hints[cell - first] >> plane_), BandModels::kHint - 1);
      const bool bit = io_.magnitudeBit(models_.significance[local][hint], cell, plane_);
      if (io_.stopped()) return;
      if (bit && !becomeSignificant(cell, n)) return;
      band_.plane[cell] = static_cast<uint8_t>(plane_);
    }
  }

  bool becomeSignificant(size_t cell, const Neighbours& n) {
    const int8_t* s = band_.sign.data() + cell;
    int context = 3 * std::clamp(s[n.near[0]] + s[n.near[1]], -1, 1) +
                  std::clamp(s[n.near[2]] + s[n.near[3]], -1, 1);
    const bool flip = context < 0;
    if (flip) context = -context;
    const bool negative = io_.signBit(models_.sign[context], cell, flip);
    if (io_.stopped()) return false;
    band_.magnitude[cell] = uint32_t{1} << plane_;
    band_.sign[cell] = negative ? -1 : 1;
    const int before = band_.plane[cell];
    band_.plane[cell] = static_cast<uint8_t>(plane_);
    io_.learned(band_, cell, 0, before);
    return true;
  }

  void refinementRow(uint32_t row, uint32_t column, uint32_t end) {
    const Neighbours n = neighboursOf(band_.shape, row);
    const size_t first = band_.shape.cell(row, column);
    for (size_t cell = first; cell < first + (end - column); ++cell) {
      const uint32_t magnitude = band_.magnitude[cell];
      if (magnitude == 0 || band_.plane[cell] <= plane_) continue;
      const uint32_t known = magnitude >> (plane_ + 1);
      const int local = localClass(localSum(cell, n));
      const int context = known == 1 ? local / 2 : known < 4 ? 6 + (local > 6) : 8;
      const bool bit = io_.magnitudeBit(models_.refinement[context], cell, plane_);
      if (io_.stopped()) return;
      const int before = band_.plane[cell];
      band_.magnitude[cell] |= uint32_t{bit} << plane_;
      band_.plane[cell] = static_cast<uint8_t>(plane_);
      io_.learned(band_, cell, magnitude, before);
    }
  }

  Band& band_;
  BandModels& models_;
  const HintSource& hints_;
  Io& io_;
  int plane_ = 0;
};

}  // namespace tetrakis
