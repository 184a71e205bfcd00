// SPDX-License-Identifier: Apache-2.0
// PlaneSynthesis is the inverse wavelet of a whole plane, or of the samples of one of its levels.
// It works in place.
//
// The low band after `level` levels holds the samples at multiples of 2^level, so that the finer
// levels need no inverse. The gain that their filters and doublings give to constants is divided
// out. Where a side is too short to be split so often the low band holds more samples than the
// level has, and those in between are left out.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline synthesis {

/// What run() leaves to that of the same plane with other coefficients. It is empty at first.
struct SynthesisMemory {
  std::vector<int32_t> coefficients, samples;
};

/// The functions are those of ViewSynthesis (view_synthesis.hpp), which says what they do.
class PlaneSynthesis {
 public:
  PlaneSynthesis(const WaveletSpec& spec, const Pyramid& pyramid, int level);

  void allocate() { values_.resize(coefficients()); }
  uint64_t coefficients() const { return pyramid_->low(level_).extent.samples(); }
  uint64_t workBytes(uint32_t threads, bool masked) const;

  bool needs(const BandPart& part) const {
    return part.subband < pyramid_->subbandsOf(level_).size();
  }
  void put(const Band& band, int fraction_bits, const BandPart& part);
  uint32_t rows(const Subband& subband) const {
    const bool lies_in_low = subband.orientation == Orientation::kLL || subband.level > level_;
    return lies_in_low ? subband.height : 0;
  }
  std::span<int32_t> row(const Subband& subband, uint32_t row);
  std::vector<int32_t> run(uint32_t threads);
  /// Returns what memory holds, where the coefficients are those of the call that filled it; else
  /// fills it.
  std::vector<int32_t> run(uint32_t threads, SynthesisMemory& memory);

 private:
  void normalise();

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
  const Extent wanted = View{level, {}}.extentIn(pyramid.plane());
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

}  // namespace tetrakis::inline synthesis
