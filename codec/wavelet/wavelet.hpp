// SPDX-License-Identifier: Apache-2.0
// forwardWavelet() turns the samples of a plane into coefficients, and inverseWavelet() takes them
// back, exactly if all coefficients are known. WaveletSpec says which transform it is, as specOf()
// reads it from a stream's header.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/forest.hpp"
#include "base/view.hpp"
#include "bitstream/stream/coding_headers.hpp"
#include "codec/wavelet/lifting/lifting.hpp"
#include "codec/wavelet/lifting/lifting_kernel.hpp"
#include "codec/wavelet/pyramid.hpp"

namespace tetrakis::inline wavelet {

// WaveletSpec says which transform a plane has, level by level, and how wide its sums are.

/// The header of a stream says it.
struct WaveletSpec {
  static constexpr size_t kChoices = 3;
  std::array<FilterId, kChoices> filters{};  ///< of level 1, of level 2, of all coarser ones
  bool whole = false;                        ///< samples have no fraction bits
  int bits = 0;                              ///< of a sample, fraction included
  int first_doubled = 3;  ///< the low band is doubled after this level and the next two; 0: never
  bool ring = false;      ///< the last column of the plane lies beside its first one
  SharedForest forest = {};  ///< the plane is the raster of a forest; every level is lifted jointly
  int finer = 0;             ///< levels of a larger plane below, whose low band this plane is

  static constexpr int kDoubled = 3;  ///< levels that double their low bands
  static constexpr int kNarrowLevels = 3;
  static constexpr int kJointBits = 20;

  /// Sums of this level are of 64 bits. Coarse low bands are larger than samples: they are doubled,
  /// and kQuiet and kOrthogonal multiply their mean by 1.71 and 1.60 at every level.
  bool wide(int level) const {
    return finer + level > kNarrowLevels || bits > widestSamples(filter(level));
  }
  FilterId filter(int level) const {
    return filters[std::min(static_cast<size_t>(finer + level), kChoices) - 1];
  }
  /// The low band is doubled after this level.
  bool doubles(int level) const {
    const int doubled = finer + level - first_doubled;
    return whole && first_doubled > 0 && doubled >= 0 && doubled < kDoubled;
  }
  /// The level lifts rows and columns jointly where it splits both and every sample exists.
  bool joint(int level) const { return whole && bits <= kJointBits && liftsJointly(filter(level)); }
  /// Joint sums of this level are of 64 bits: they have kJointPlaces binary places.
  bool jointlyWide(int level) const {
    return finer + level > kNarrowLevels || bits + kJointPlaces >= widestSamples(filter(level));
  }
  /// The transform of the low band of a level, as a plane.
  WaveletSpec above(int level) const {
    WaveletSpec coarser = *this;
    coarser.finer += level;
    return coarser;
  }
};

/// The pyramid of a plane: of its forest, or of a grid whose lifted samples are marked.
inline Pyramid pyramidOf(const WaveletSpec& spec, SampleMarks lifted, Extent plane,
                         HeldSamples held = {}) {
  if (spec.forest != nullptr) return Pyramid(*spec.forest, held);
  return {std::move(lifted), plane, held};
}

/// What is decoded for a view: windows of a forest only if its samples are made of coefficients
/// alone, which find the owners of shared samples in other patches.
inline View viewOnForest(const auto& header, const View& view, bool of_coefficients) {
  return header.wavelet.forest != nullptr && view.window && !of_coefficients ? View{} : view;
}

// specOf(), unroundedBits() and fractionBitsOf() turn the fields of a stream header about the
// wavelet into the arguments of the transform, and withFractions() the values.

inline WaveletSpec specOf(const WaveletHeader& header) {
  WaveletSpec spec;
  std::transform(header.filters.begin(), header.filters.end(), spec.filters.begin(),
                 [](uint8_t id) { return static_cast<FilterId>(id); });
  spec.whole = header.fraction_bits == 0;
  spec.bits = header.bits;
  spec.first_doubled = header.first_doubled;
  spec.ring = header.ring;
  spec.forest = header.forest;
  return spec;
}

/// Values as the transform takes them.
inline std::vector<int32_t> withFractions(std::span<const int32_t> values, int fraction_bits) {
  std::vector<int32_t> scaled(values.begin(), values.end());
  for (int32_t& value : scaled) value <<= fraction_bits;
  return scaled;
}

/// The binary places of coefficients of samples without fraction bits in an inverse that is not to
/// restore them: as many as fit.
inline int unroundedBits(int bit_planes) {
  return std::clamp(19 - bit_planes, 0, 4);
}

/// The fraction bits that values have in the inverse down to a mip level: those of the header, or,
/// if it has none and so much is unknown that roundings would add to it, as many as fit. Mip levels
/// above 0 are never rounded: details that they do not know made the fractions that they are made
/// of. bytes: of the coefficients, in all tracks together.
inline int fractionBitsOf(const WaveletHeader& header, int bit_planes, uint64_t bytes, int level) {
  if (header.fraction_bits > 0) return header.fraction_bits;
  return level == 0 && bytes >= header.rounded_bytes ? 0 : unroundedBits(bit_planes);
}

// forwardWavelet() and inverseWavelet() are the transform: a reversible integer wavelet of a plane.
// Heights and the colour planes of a texture share it.
//
// Every level rounds, and the rounding errors of coarse levels spread over the whole plane. Planes
// with fraction bits (lossy ones, shifted left by up to four bits) keep these errors below a step.
// Planes without them (lossless ones) round each coefficient once
// (codec/wavelet/lifting/lifting.hpp). The low bands of three levels are doubled, so that
// coarser levels round half as much: prefixes get better, lossless streams a little longer
// (docs/EXPERIMENTS.md).

/// Turns the samples of the plane of a pyramid into coefficients, in place, laid out as
/// codec/wavelet/pyramid.hpp says. inverseWavelet() with the same spec and an equal pyramid undoes
/// it exactly. Samples that do not exist are left alone; those that are held have their values, and
/// the places of their coefficients may be anything afterwards.
void forwardWavelet(const WaveletSpec& spec, const Pyramid& pyramid, std::span<int32_t> values,
                    uint32_t threads = 1);

/// How coefficients become samples.
struct InverseOptions {
  int level = 0;         ///< whose low band they become: the coarser levels alone are undone
  uint32_t threads = 1;  ///< nothing depends on them
};

/// Turns coefficients into the low band of a level, which is a plane of its own, in place; that of
/// level 0 are the samples. Defined for all values. low: the values of that low band. Where samples
/// are held any values will do.
void inverseWavelet(const WaveletSpec& spec, const Pyramid& pyramid, std::span<int32_t> low,
                    const InverseOptions& options = {});

}  // namespace tetrakis::inline wavelet
