// SPDX-License-Identifier: Apache-2.0
// ViewSynthesis takes the coefficients that a view needs and returns the samples of the view. It
// does so as PlaneSynthesis for a whole plane or one of its levels, and for a window, whose cost
// follows its size, as WindowSynthesis or ForestWindowSynthesis.
#pragma once

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "base/view.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/level_transform.hpp"
#include "codec/wavelet/synthesis/forest_window_synthesis.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline synthesis {

// WindowSynthesis is the inverse wavelet of a window of the plane, or of the samples of one of its
// levels. It gives the samples that the inverse wavelet of the whole plane, or of the level, would
// give there, from the coefficients that reach the window. At every level
// the window grows by the reach of the filter and then halves, so the work follows the size of the
// window and not that of the plane. Of a plane whose columns go round, a level whose block would
// reach across the seam takes whole rows: those are rings.
//
// Coefficients that lie outside must not change a window. So the stream header says how many bytes
// a complete track has, because a window cannot see whether all tracks are complete; and sums
// beside voids always have 64 bits.

/// What a view shows of the low band of its level, whose samples lie closer together where a side
/// is too short to be split so often.
struct ShownLow {
  Window window;                    ///< of the low band, from the first shown sample to the last
  uint32_t step_x = 1, step_y = 1;  ///< from one shown sample to the next

  ShownLow(const Pyramid& pyramid, const View& view);

  /// Keeps the shown ones of the values of the window.
  template <class T>
  void thin(std::vector<T>& values) const {
    if (step_x == 1 && step_y == 1) return;
    size_t count = 0;
    for (uint32_t y = 0; y < window.height; y += step_y)
      for (uint32_t x = 0; x < window.width; x += step_x)
        values[count++] = values[size_t{y} * window.width + x];
    values.resize(count);
  }
};

/// Takes the gain that the finer levels give to constants out of values of the low band of a level.
void takeOutGain(const WaveletSpec& spec, const Pyramid& pyramid, int level,
                 std::span<int32_t> values);

/// The functions are those of ViewSynthesis, which says what they do.
class WindowSynthesis {
 public:
  /// view: with a window.
  WindowSynthesis(const WaveletSpec& spec, const Pyramid& pyramid, const View& view);

  void allocate();
  uint64_t coefficients() const;
  uint64_t workBytes(uint32_t threads, bool masked) const;

  bool mayNeed(const Region& region) const;
  bool needs(const BandPart& part) const;
  void put(const Band& band, int fraction_bits, const BandPart& part);
  Window needed(const Subband& subband) const;
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
  const Level& at(int level) const { return levels_[static_cast<size_t>(level - level_ - 1)]; }
  Level& at(int level) { return levels_[static_cast<size_t>(level - level_ - 1)]; }
  Target targetOf(const Subband& subband) const;
  int32_t* valuesOf(const Subband& subband);
  void copyLow(const std::vector<int32_t>& low, int level);
  std::vector<uint8_t> maskOf(int level) const;
  LevelTransform transformOf(int level) const;

  WaveletSpec spec_;
  const Pyramid* pyramid_;
  int level_;
  ShownLow shown_;
  std::vector<Level> levels_;  ///< [l - level_ - 1]: what level l works on
  Range ll_x_, ll_y_;
  std::vector<int32_t> ll_;
};

// PlaneSynthesis is the inverse wavelet of a whole plane, or of the samples of one of its levels.
// It works in place.
//
// The low band after `level` levels holds the samples at multiples of 2^level, so that the finer
// levels need no inverse. The gain that their filters and doublings give to constants is divided
// out. Where a side is too short to be split so often the low band holds more samples than the
// level has, and those in between are left out.

/// What run() leaves to that of the same plane with other coefficients. It is empty at first.
struct SynthesisMemory {
  std::vector<int32_t> coefficients, samples;
};

/// The functions are those of ViewSynthesis, which says what they do.
class PlaneSynthesis {
 public:
  PlaneSynthesis(const WaveletSpec& spec, const Pyramid& pyramid, int level);

  void allocate() { values_.resize(coefficients()); }
  uint64_t coefficients() const { return pyramid_->low(level_).extent.samples(); }
  uint64_t workBytes(uint32_t threads, bool masked) const;

  bool mayNeed(const Region& region) const { return region.isBase() || region.last_level > level_; }
  bool needs(const BandPart& part) const {
    return pyramid_->isIn(pyramid_->subbands()[part.subband], level_);
  }
  void put(const Band& band, int fraction_bits, const BandPart& part);
  Window needed(const Subband& subband) const {
    return {0, 0, subband.width, pyramid_->isIn(subband, level_) ? subband.height : 0};
  }
  std::span<int32_t> row(const Subband& subband, uint32_t row);
  std::vector<int32_t> run(uint32_t threads);
  /// Returns what memory holds, where the coefficients are those of the call that filled it; else
  /// fills it.
  std::vector<int32_t> run(uint32_t threads, SynthesisMemory& memory);

 private:
  WaveletSpec spec_;
  const Pyramid* pyramid_;
  int level_;
  std::vector<int32_t> values_;  ///< of the low band
};

/// Moves the samples at multiples of 2^level of the plane to the front of the values of the low
/// band of that level, and returns how many they are.
template <class T>
size_t thin(const Pyramid& pyramid, int level, std::span<T> low) {
  const LowBand& band = pyramid.low(level);
  const Extent wanted = View{level, {}, 0, pyramid.low(0).patch_rows}.extentIn(pyramid.plane());
  assert(low.size() == band.extent.samples() && wanted.samples() <= low.size());
  if (wanted == band.extent) return low.size();
  for (uint32_t y = 0; y < wanted.height; ++y) {
    for (uint32_t x = 0; x < wanted.width; ++x) {
      const size_t from = (size_t{y} << (level - band.splits_y)) * band.extent.width +
                          (size_t{x} << (level - band.splits_x));
      low[size_t{y} * wanted.width + x] = low[from];
    }
  }
  return wanted.samples();
}

// ViewSynthesis is the inverse wavelet of what a view shows of a plane: coefficients go in, and the
// samples of the view come out. A view of a whole plane, or of one of its levels, is worked out in
// place. A window is worked out from the coefficients that reach it, and has the same samples that
// the whole plane has there.

class ViewSynthesis {
 public:
  /// The pyramid outlives this object. Its mask says which samples exist.
  ViewSynthesis(const WaveletSpec& spec, const Pyramid& pyramid, const View& view)
      : kernel_(kernelOf(spec, pyramid, view)) {}

  /// Makes room for the coefficients, which are 0 until they are put. Comes before put() and row().
  void allocate() {
    std::visit([](auto& kernel) { kernel.allocate(); }, kernel_);
  }
  /// How many coefficients allocate() makes room for.
  uint64_t coefficients() const {
    return std::visit([](const auto& kernel) { return kernel.coefficients(); }, kernel_);
  }
  /// The bytes that run() allocates at most beside the coefficients. masked: whether the mask of
  /// the pyramid will have bytes.
  uint64_t workBytes(uint32_t threads, bool masked) const {
    return std::visit([&](const auto& kernel) { return kernel.workBytes(threads, masked); },
                      kernel_);
  }

  /// False only if samples of the view depend on no coefficient of the region.
  bool mayNeed(const Region& region) const {
    return std::visit([&](const auto& kernel) { return kernel.mayNeed(region); }, kernel_);
  }
  /// True if samples of the view depend on coefficients of the part.
  bool needs(const BandPart& part) const {
    return std::visit([&](const auto& kernel) { return kernel.needs(part); }, kernel_);
  }
  /// Takes what is known of the coefficients of a part, as far as they are needed, with
  /// `fraction_bits` binary places more than they were coded with. Parts that do not overlap may be
  /// put at the same time.
  void put(const Band& band, int fraction_bits, const BandPart& part) {
    std::visit([&](auto& kernel) { kernel.put(band, fraction_bits, part); }, kernel_);
  }

  /// The coefficients of a subband that are needed, as a rectangle of it, and a row of that in
  /// place.
  Window needed(const Subband& subband) const {
    return std::visit([&](const auto& kernel) { return kernel.needed(subband); }, kernel_);
  }
  std::span<int32_t> row(const Subband& subband, uint32_t row) {
    return std::visit([&](auto& kernel) { return kernel.row(subband, row); }, kernel_);
  }

  /// Returns the samples of the view, row by row. Those that do not exist may be anything. Called
  /// once, at the end.
  std::vector<int32_t> run(uint32_t threads) {
    return std::visit([&](auto& kernel) { return kernel.run(threads); }, kernel_);
  }
  /// memory: of this plane; no view is a window.
  std::vector<int32_t> run(uint32_t threads, SynthesisMemory& memory) {
    return std::get<PlaneSynthesis>(kernel_).run(threads, memory);
  }

 private:
  using Kernel = std::variant<PlaneSynthesis, WindowSynthesis, ForestWindowSynthesis>;

  static Kernel kernelOf(const WaveletSpec& spec, const Pyramid& pyramid, const View& view) {
    if (view.window && spec.forest != nullptr) return ForestWindowSynthesis(spec, pyramid, view);
    if (view.window) return WindowSynthesis(spec, pyramid, view);
    return PlaneSynthesis(spec, pyramid, view.level);
  }
  Kernel kernel_;
};

/// Of each part of a region whether the view needs it; none if it needs none.
std::vector<bool> neededParts(const ViewSynthesis& synthesis, std::span<const Subband> subbands,
                              const Region& region);

}  // namespace tetrakis::inline synthesis
