// SPDX-License-Identifier: Apache-2.0
// Transforms and sizes that the tests of the wavelet go through.
#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <vector>

#include "codec/wavelet/wavelet.hpp"
#include "tests/support/random_planes.hpp"

namespace tetrakis {

inline std::ostream& operator<<(std::ostream& out, Orientation orientation) {
  constexpr const char* kNames[] = {"LL", "HL", "LH", "HH"};
  return out << kNames[static_cast<size_t>(orientation)];
}

inline std::ostream& operator<<(std::ostream& out, const WaveletSpec& spec) {
  for (const FilterId id : spec.filters) out << static_cast<int>(id);
  return out << (spec.whole ? " doubled" : "") << ", " << spec.bits << " bits";
}

namespace test {

inline constexpr std::array<FilterId, kFilters> kAllFilters = {
    FilterId::kShort, FilterId::kSixTap, FilterId::kQuiet,
    FilterId::kLong,  FilterId::kSmooth, FilterId::kOrthogonal};
/// Those that keep the mean, and may be lifted jointly.
inline constexpr std::array<FilterId, 4> kTwoStepFilters = {FilterId::kShort, FilterId::kSixTap,
                                                            FilterId::kLong, FilterId::kSmooth};

struct Size {
  uint32_t width, height;
  size_t count() const { return size_t{width} * height; }
  Extent extent() const { return {width, height}; }
};

/// Of planes with voids or held samples: lines, small and odd sides, more levels one way.
inline constexpr Size kMaskedSizes[] = {{1, 1}, {1, 9},   {9, 1},   {2, 2},   {5, 3},
                                        {9, 2}, {17, 17}, {40, 23}, {64, 65}, {2, 300}};

inline std::vector<Subband> subbandsOf(const Size& size) {
  return Pyramid(size.extent()).subbands();
}

inline std::ostream& operator<<(std::ostream& out, const Size& size) {
  return out << size.width << " x " << size.height;
}

/// Sample bits for which every filter takes 64-bit sums, and for which none does.
inline constexpr int kWideBits = 31, kNarrowBits = 16;

inline WaveletSpec uniform(FilterId id, bool doubled = false, int bits = kNarrowBits) {
  return {{id, id, id}, doubled, bits};
}

inline WaveletSpec withBits(WaveletSpec spec, int bits) {
  spec.bits = bits;
  return spec;
}

inline Plane forward(const WaveletSpec& spec, Plane plane, const Size& size, Mask valid = {}) {
  forwardWavelet(spec, Pyramid(size.extent(), valid), plane);
  return plane;
}

inline Plane inverse(const WaveletSpec& spec, Plane plane, const Size& size, Mask valid = {}) {
  inverseWavelet(spec, Pyramid(size.extent(), valid), plane);
  return plane;
}

inline std::vector<WaveletSpec> mixedSpecs() {
  constexpr auto kS = FilterId::kShort, kM = FilterId::kSixTap, kQ = FilterId::kQuiet,
                 kL = FilterId::kLong, kO = FilterId::kOrthogonal;
  return {{{kL, kL, kO}, false, kNarrowBits},
          {{kL, kO, kO}, false, kNarrowBits},
          {{kL, kQ, kQ}, false, kNarrowBits},
          {{kS, kQ, kM}, true, kNarrowBits}};
}

/// Every filter on all levels, with and without doubling, and mixed ones.
inline std::vector<WaveletSpec> allSpecs() {
  std::vector<WaveletSpec> specs = mixedSpecs();
  for (const FilterId id : kAllFilters) {
    for (const bool doubled : {false, true}) specs.push_back(uniform(id, doubled));
  }
  return specs;
}

/// Column and row of the plane's sample in whose place a coefficient of the band stands.
inline uint32_t sampleColumn(const Subband& band, uint32_t column) {
  return (column << band.splits_x) + (band.isHighX() ? uint32_t{1} << (band.splits_x - 1) : 0);
}

/// f(index in the plane of coefficients, index of the sample whose place it is) for a whole band.
template <class F>
void forEachCoefficient(const Subband& band, uint32_t plane_width, F f) {
  for (uint32_t row = 0; row < band.height; ++row) {
    const size_t line = size_t{band.planeRow(row)} * plane_width;
    for (uint32_t column = 0; column < band.width; ++column) {
      f(line + band.x + column, line + sampleColumn(band, column));
    }
  }
}

}  // namespace test
}  // namespace tetrakis
