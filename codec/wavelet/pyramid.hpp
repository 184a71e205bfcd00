// SPDX-License-Identifier: Apache-2.0
// Pyramid says where the bands of a transformed plane lie, and which of their coefficients exist.
// It takes the size of the plane, the mask of its samples, and the HeldSamples whose values are
// known before any coefficient.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/forest.hpp"
#include "base/plane.hpp"
#include "base/sample_marks.hpp"
#include "base/view.hpp"
#include "bitstream/track/band.hpp"

namespace tetrakis::inline wavelet {

// HeldSamples lists the samples that have their values before any coefficient is decoded: areas of
// constant height.

/// Area a holds the samples of number a + 1, and all of them have values[a]. The numbers and the
/// values belong to somebody else, who keeps them alive.
struct HeldSamples {
  std::span<const uint16_t>
      numbers;                      ///< one a sample, row by row: 0 for free ones; empty: all free
  std::span<const int32_t> values;  ///< one an area

  bool none() const { return numbers.empty(); }
};

// The pyramid of a plane holds the low bands that a dyadic wavelet splits the plane into, level by
// level, and the bands of coefficients that each split leaves behind.
//
// Level 1 splits the plane, and level l + 1 splits the low band of level l. The coefficients stay
// in the plane. Rows stay where they are (the low band of level l has every 2^l-th row), so that no
// column is ever copied. Within a row the low half comes before the high half. A side of
// kSmallestSide samples or fewer is not split.
//
//   HL: high along the rows (x), low along the columns (y);  LH: the other way;  HH: high in both
//
// In a height field every coefficient belongs to one vertex of the 4-8 lattice: those of HH belong
// to the centres of its squares, those of HL and LH to the midpoints of the sides.

/// A side of so many samples or fewer is not split. HL or LH, and HH, are empty then.
inline constexpr uint32_t kSmallestSide = 4;
inline constexpr size_t kBandsPerLevel = 3;
inline constexpr int kMaxLevels = 19;  ///< enough for sides up to 2^21

/// One band of coefficients in the plane.
struct Subband {
  int level = 0;  ///< the level whose split made the band; LL has the coarsest level
  Orientation orientation = Orientation::kLL;
  uint32_t width = 0, height = 0;  ///< in coefficients
  uint32_t x = 0, y = 0;           ///< column and row of the plane that the first coefficient is in
  int splits_x = 0, splits_y = 0;  ///< how often each direction was split down to this band
  uint32_t patch = 0;              ///< of a forest, that the band belongs to
  uint32_t patch_row = 0;  ///< the row of the plane that the patch begins in; y counts from it

  bool isHighX() const {
    return orientation == Orientation::kHL || orientation == Orientation::kHH;
  }
  bool isHighY() const {
    return orientation == Orientation::kLH || orientation == Orientation::kHH;
  }

  /// The row of the plane that a row of the band lies in.
  uint32_t planeRow(uint32_t row) const { return patch_row + patchRow(row); }
  uint32_t patchRow(uint32_t row) const { return y + (row << splits_y); }
  /// The column of the sample that a column of the band belongs to.
  uint32_t sampleColumn(uint32_t column) const {
    return (column << splits_x) + (isHighX() ? uint32_t{1} << (splits_x - 1) : 0);
  }
};

/// The low band that is left after so many levels.
struct LowBand {
  Extent extent;
  uint32_t patch_rows;             ///< of each patch of a forest; else all rows
  int splits_x = 0, splits_y = 0;  ///< how often each direction was split; at most once a level
};

class Pyramid {
 public:
  /// The mask marks the samples of the plane that exist. What is held outlives the pyramid.
  explicit Pyramid(Extent plane, Mask valid = {}, HeldSamples held = {})
      : Pyramid(SampleMarks(sharedBits(valid, plane)), plane, held) {}
  /// The same, of marks that are there as bits. most_levels: coarser ones are not split.
  Pyramid(SampleMarks valid, Extent plane, HeldSamples held = {}, int most_levels = kMaxLevels);
  /// The raster of a forest: each patch has a pyramid of its own, in which the samples exist that
  /// it owns. What is held outlives the pyramid.
  explicit Pyramid(const Forest& forest, HeldSamples held = {});
  /// What that pyramid takes.
  static uint64_t bytesOf(const Forest& forest);

  Extent plane() const { return lows_.front().extent; }
  bool allExist() const { return owned_ == nullptr && valid_.allExist(); }
  /// Of a pyramid whose marks are those of the whole plane, and of no forest.
  bool exists(uint32_t x, uint32_t y) const { return allExist() || valid_.whole()->at(x, y); }
  /// Which samples exist of 32 coefficients of a row of a band, the first of which belongs to the
  /// sample (x, y).
  uint32_t existing(const Subband& band, uint32_t x, uint32_t y) const {
    if (allExist()) return ~uint32_t{0};
    if (owned_ != nullptr) return owned_->every(band.splits_x, band.patch, x, y - band.patch_row);
    const int split = band.orientation == Orientation::kLL ? band.level : band.level - 1;
    return valid_.every(split, band.splits_x, x, y);
  }
  HeldSamples held() const { return held_; }

  /// The number of levels, which is also the number of the coarsest one. 0 for the smallest planes.
  int levels() const { return static_cast<int>(lows_.size()) - 1; }
  /// The low band of a level, from 0 (the plane itself) to levels().
  const LowBand& low(int level) const { return lows_[static_cast<size_t>(level)]; }
  bool splitsX(int level) const { return low(level).splits_x > low(level - 1).splits_x; }
  bool splitsY(int level) const { return low(level).splits_y > low(level - 1).splits_y; }

  /// LL, then HL, LH and HH of the coarsest level, and so on to level 1: 3 * levels() + 1 bands,
  /// some of them empty. Those of a forest follow patch by patch. Together they fill the plane.
  const std::vector<Subband>& subbands() const { return subbands_; }
  /// Whether the band is one of those that fill the low band of a level.
  bool isIn(const Subband& subband, int level) const {
    return subband.orientation == Orientation::kLL || subband.level > level;
  }

  /// The index of the first coefficient of a row of a subband among the values of the low band of a
  /// level, which holds that subband.
  size_t indexOf(const Subband& subband, uint32_t row, int level = 0) const {
    return size_t{lowRow(subband, row, level)} * low(level).extent.width + subband.x;
  }
  /// The row of the low band of a level that a row of a subband of it lies in.
  uint32_t lowRow(const Subband& subband, uint32_t row, int level) const {
    const LowBand& band = low(level);
    return subband.patch * band.patch_rows + (subband.patchRow(row) >> band.splits_y);
  }

  /// Which samples exist of a rectangle of the low band of a level, laid out like the values that
  /// the next level leaves there: where it splits rows, the rectangle begins at an even column, and
  /// the even columns come before the odd ones. Not all samples of the pyramid exist.
  std::vector<uint8_t> splitMask(int level, const Window& block) const;

 private:
  void splitAll(int most_levels);
  void addSubbands();
  void addSubbands(int level);

  SampleMarks valid_;
  std::shared_ptr<const OwnedSides> owned_;  ///< of a forest; else null
  HeldSamples held_;
  std::vector<LowBand> lows_;
  std::vector<Subband> subbands_;
};

/// The number of the coarsest level of a plane.
inline int coarsestLevel(Extent plane) {
  return Pyramid(plane).levels();
}

}  // namespace tetrakis::inline wavelet
