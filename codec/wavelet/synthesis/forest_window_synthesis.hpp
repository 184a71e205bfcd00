// SPDX-License-Identifier: Apache-2.0
// ForestWindowSynthesis is the inverse wavelet of a window of the raster of a forest, or of one of
// its levels. It gives the samples that the inverse of the whole forest would give there, from the
// coefficients that reach the window, on all patches that they lie on.
//
// At every level a block of each patch is lifted (codec/wavelet/forest_reach.hpp), which grows by
// the reach of the filter and then halves, so the work follows the size of the window. Of all
// patches LL is there, which has 3 x 3 coefficients of each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/view.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/forest_reach.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline synthesis {

/// The blocks of a window, and the bytes of its synthesis. They follow from the forest and the
/// filters alone.
class ForestBlocks {
 public:
  /// spec: with a forest. view: with a window.
  ForestBlocks(const WaveletSpec& spec, const View& view);

  int levels() const { return level_ + static_cast<int>(blocks_.size()); }
  /// Of a level, from that of the view + 1 on.
  const PatchWindows& at(int level) const {
    return blocks_[static_cast<size_t>(level - level_ - 1)];
  }
  uint64_t coefficients() const;
  uint64_t workBytes() const;

 private:
  int level_;
  uint64_t shown_, patches_;
  std::vector<PatchWindows> blocks_;
};

/// The functions are those of ViewSynthesis, which says what they do.
class ForestWindowSynthesis {
 public:
  ForestWindowSynthesis(const WaveletSpec& spec, const Pyramid& pyramid, const View& view);

  void allocate();
  uint64_t coefficients() const { return blocks_.coefficients(); }
  uint64_t workBytes(uint32_t, bool) const { return blocks_.workBytes(); }

  bool mayNeed(const Region& region) const;
  bool needs(const BandPart& part) const;
  void put(const Band& band, int fraction_bits, const BandPart& part);
  Window needed(const Subband& subband) const;
  std::span<int32_t> row(const Subband& subband, uint32_t row);
  /// Works on the calling thread alone.
  std::vector<int32_t> run(uint32_t threads);

 private:
  using Values = std::vector<std::vector<int32_t>>;  ///< of each patch, those of its block

  Values& valuesAt(int level) { return values_[static_cast<size_t>(level - level_ - 1)]; }
  void putLow(const Values& finished, int level);
  std::vector<int32_t> shownOf(const Values& finished) const;

  WaveletSpec spec_;
  const Pyramid* pyramid_;
  int level_;
  Window window_;
  ForestBlocks blocks_;
  std::vector<Values> values_;  ///< of each level; even columns before odd ones
  std::vector<int32_t> ll_;     ///< of all patches, as their raster
};

}  // namespace tetrakis::inline synthesis
