// SPDX-License-Identifier: Apache-2.0
// The inverse wavelet of a window: the samples that inverseWavelet would give there, from the
// coefficients that reach it. At every level the window grows by the reach of the filter and then
// halves, so that work follows the size of the window and not that of the plane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wavelet/band_plan.hpp"
#include "wavelet/wavelet.hpp"

namespace tetrakis {

/// A rectangle of samples.
struct Window {
  uint32_t x = 0, y = 0, width = 0, height = 0;
};

/// The window's part of a plane of that width.
template <class T>
std::vector<T> crop(std::span<const T> plane, uint32_t plane_width, const Window& window) {
  std::vector<T> out;
  out.reserve(size_t{window.width} * window.height);
  for (uint32_t y = 0; y < window.height; ++y) {
    const T* row = plane.data() + size_t{window.y + y} * plane_width + window.x;
    out.insert(out.end(), row, row + window.width);
  }
  return out;
}

class WindowSynthesis {
 public:
  /// The window lies in the plane of width * height samples and holds one or more. `subbands`
  /// outlive this object.
  WindowSynthesis(const WaveletSpec& spec, std::span<const Subband> subbands, uint32_t width,
                  uint32_t height, const Window& window);

  /// Before anything is put.
  void allocate();
  /// Coefficients that allocate() makes room for.
  uint64_t samples() const;
  /// Of the largest block that a level works on, and of the largest part that run() takes out of
  /// one for the next level, or for the window.
  uint64_t largestBlock() const;
  uint64_t largestPart() const;

  /// Whether the samples depend on any coefficient of the part.
  bool needs(const BandPart& part) const;

  /// As scatter(), of what is needed. Parts that do not overlap may be put at the same time.
  void put(const Band& band, int fraction_bits, const BandPart& part);

  /// The coefficients of a subband that are needed: how many rows, and each in place.
  uint32_t rows(const Subband& subband);
  std::span<int32_t> row(const Subband& subband, uint32_t row);

  /// The samples of the window, row by row. valid: of the whole plane, or empty.
  std::vector<int32_t> run(Validity valid);

 private:
  /// Half-open.
  struct Range {
    uint32_t begin, end;
    uint32_t size() const { return end - begin; }
  };
  /// One direction of the low band that a level starts from.
  struct Axis {
    Range block;  ///< what the level works on; begins at an even place where it is split
    Range low;    ///< of its low half
    Range high;   ///< of its high half; empty where it is not split
    int splits;   ///< of the plane, down to that low band

    bool split() const { return high.size() > 0; }
    /// Place of a coefficient in the block's rows or columns.
    Range wanted(bool is_high) const { return is_high ? high : low; }
  };
  struct Level {
    Axis x, y;
    std::vector<int32_t> values;  ///< of the block: low columns before high ones, rows in place

    size_t samples() const { return size_t{x.block.size()} * y.block.size(); }
  };
  /// The coefficients of a subband that are needed, and where they go.
  struct Target {
    Range columns, rows;
    std::vector<int32_t>* values;
    size_t first, row_pitch;  ///< index of the first coefficient; from one row to the next
  };

  Axis axisOf(Range needed, uint32_t size, int level, int splits) const;
  Target targetOf(const Subband& subband);
  void copyLow(const std::vector<int32_t>& low, int level);
  std::vector<uint8_t> validityOf(const Level& level, Validity valid) const;

  WaveletSpec spec_;
  std::span<const Subband> subbands_;
  uint32_t width_;
  Window window_;
  std::vector<Level> levels_;  ///< [l - 1]: level l
  Range ll_x_, ll_y_;
  std::vector<int32_t> ll_;
};

}  // namespace tetrakis
