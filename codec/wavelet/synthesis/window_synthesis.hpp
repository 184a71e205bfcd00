// SPDX-License-Identifier: Apache-2.0
// WindowSynthesis is the inverse wavelet of a window. It gives the samples that the inverse wavelet
// of the whole plane would give there, from the coefficients that reach the window. At every level
// the window grows by the reach of the filter and then halves, so the work follows the size of the
// window and not that of the plane. Of a plane whose columns go round, a level whose block would
// reach across the seam takes whole rows: those are rings.
//
// Coefficients that lie outside must not change a window. So the stream header says how many bytes
// a complete track has, because a window cannot see whether all tracks are complete; and sums
// beside voids always have 64 bits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/view.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/level_transform.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline synthesis {

/// The functions are those of ViewSynthesis (view_synthesis.hpp), which says what they do.
class WindowSynthesis {
 public:
  WindowSynthesis(const WaveletSpec& spec, const Pyramid& pyramid, const Window& window);

  void allocate();
  uint64_t coefficients() const;
  uint64_t workBytes(uint32_t threads, bool masked) const;

  bool needs(const BandPart& part) const;
  void put(const Band& band, int fraction_bits, const BandPart& part);
  uint32_t rows(const Subband& subband) const;
  std::span<int32_t> row(const Subband& subband, uint32_t row);
  /// Works on the calling thread alone.
  std::vector<int32_t> run(uint32_t threads);

 private:
  /// Half-open.
  struct Range {
    uint32_t begin, end;
    uint32_t size() const { return end - begin; }
  };
  /// One direction of the low band that a level splits.
  struct Axis {
    Range block;  ///< what the level works on; begins at an even place where it is split
    Range low;    ///< the part of the low half
    Range high;   ///< the part of the high half; empty where this direction is not split

    bool split() const { return high.size() > 0; }
    bool isWhole(uint32_t size) const { return block.size() == size; }
    /// The part of one of the halves.
    Range wanted(bool is_high) const { return is_high ? high : low; }
  };
  struct Level {
    Axis x, y;
    std::vector<int32_t> values;  ///< of the block: low columns before high ones, rows in place

    Window block() const { return {x.block.begin, y.block.begin, x.block.size(), y.block.size()}; }
    Window low() const { return {x.low.begin, y.low.begin, x.low.size(), y.low.size()}; }
    size_t samples() const { return block().extent().samples(); }
    SplitBlock split() { return {values.data(), x.block.size(), block().extent(), low().extent()}; }
  };
  /// The coefficients of a subband that are needed, and where they lie among the values of a block
  /// or of LL.
  struct Target {
    Range columns, rows;
    size_t first, row_pitch;  ///< index of the first coefficient; from one row to the next

    size_t index(uint32_t row) const { return first + (row - rows.begin) * row_pitch; }
  };

  static Axis axisOf(Range needed, bool splits, uint32_t size, uint32_t reach);
  /// Of rows, which may be rings.
  Axis rowAxisOf(Range needed, int level) const;
  const Level& at(int level) const { return levels_[static_cast<size_t>(level - 1)]; }
  Target targetOf(const Subband& subband) const;
  int32_t* valuesOf(const Subband& subband);
  void copyLow(const std::vector<int32_t>& low, int level);
  std::vector<uint8_t> maskOf(int level) const;
  LevelTransform transformOf(int level) const;

  WaveletSpec spec_;
  const Pyramid* pyramid_;
  Window window_;
  std::vector<Level> levels_;  ///< [l - 1]: what level l works on
  Range ll_x_, ll_y_;
  std::vector<int32_t> ll_;
};

}  // namespace tetrakis::inline synthesis
