// SPDX-License-Identifier: Apache-2.0
// The transform is a reversible integer wavelet of a plane. Heights and the colour planes of a
// texture share it.
//
// Every level rounds, and the rounding errors of coarse levels spread over the whole plane. Planes
// with fraction bits keep these errors below a step. Planes without them (lossless ones) round each
// coefficient once (wavelet/lifting/joint_lifting.hpp). The finest levels do not round their low
// bands at all, but carry the fractions to the next one. Then the low bands of three levels are
// doubled, so that coarser levels round half as much: prefixes get better, lossless streams a
// little longer. docs/EXPERIMENTS.md says by how much.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "wavelet/lifting/joint_lifting.hpp"
#include "wavelet/lifting/lifting_filter.hpp"
#include "wavelet/pyramid.hpp"

namespace tetrakis::inline wavelet {

/// Which transform: stands in the stream header.
struct WaveletSpec {
  static constexpr size_t kChoices = 3;
  std::array<FilterId, kChoices> filters{};  ///< of level 1, of level 2, of all coarser ones
  bool whole = false;                        ///< samples have no fraction bits
  int bits = 0;                              ///< of a sample, fraction included
  int first_doubled = 3;  ///< the low band is doubled after this level and the next two; 0: never

  static constexpr int kDoubled = 3;  ///< levels that double their low bands
  static constexpr int kNarrowLevels = 3;
  static constexpr int kJointBits = 20;

  /// Sums of this level are of 64 bits. Coarse low bands are larger than samples: they are doubled,
  /// and kOrthogonal multiplies their mean by 1.60 at every level.
  bool wide(int level) const {
    return level > kNarrowLevels || bits > widestSamples(filter(level));
  }
  FilterId filter(int level) const {
    return filters[std::min(static_cast<size_t>(level), kChoices) - 1];
  }
  /// The low band is doubled after this level.
  bool doubles(int level) const {
    return whole && first_doubled > 0 && level >= first_doubled && level < first_doubled + kDoubled;
  }
  /// The level lifts rows and columns jointly where it splits both and every sample exists.
  bool joint(int level) const { return whole && bits <= kJointBits && liftsJointly(filter(level)); }
  /// Joint sums of this level are of 64 bits: they have kJointPlaces binary places.
  bool jointlyWide(int level) const {
    return level > kNarrowLevels || bits + kJointPlaces >= widestSamples(filter(level));
  }
};

/// The last of the levels that pass fractions on, from the first to this one, which rounds; 0: none
/// do. These levels lift jointly. The first level that doubles its low band is the last at most.
int carriedTo(const WaveletSpec& spec, const Pyramid& pyramid);

/// Turns the samples of the plane of a pyramid into coefficients, in place, laid out as
/// wavelet/pyramid.hpp says. inverseWavelet() with the same spec and an equal pyramid undoes it
/// exactly. Samples that do not exist are left alone; those that are held have their values, and
/// the places of their coefficients may be anything afterwards.
void forwardWavelet(const WaveletSpec& spec, const Pyramid& pyramid, std::span<int32_t> values,
                    uint32_t threads = 1);

/// How coefficients become samples.
struct InverseOptions {
  int level = 0;  ///< whose low band they become: the coarser levels alone are undone
  /// The values are whole coefficients, known to the last bit or nearly, and roundings are undone.
  /// Else fractions are not carried; nor are they where level > 0.
  bool rounds = true;
  uint32_t threads = 1;  ///< nothing depends on them
};

/// Turns coefficients into the low band of a level, which is a plane of its own, in place; that of
/// level 0 are the samples. Defined for all values. low: the values of that low band. Where samples
/// are held any values will do.
void inverseWavelet(const WaveletSpec& spec, const Pyramid& pyramid, std::span<int32_t> low,
                    const InverseOptions& options = {});

class HeldBlock;

/// A block of the low band that a level splits, which stands for itself.
struct LevelBlock {
  std::span<int32_t> values;        ///< the low half of a row first; low rows at even places
  Extent extent, low;               ///< of the block and of its low part
  std::vector<uint8_t> existing;    ///< Pyramid::splitMask() of the block; empty: all exist
  const HeldBlock* held = nullptr;  ///< null: all samples are free
  bool fractions_in = false, fractions_out = false;  ///< as in JointBlock
  std::span<const uint8_t> fractions = {};           ///< likewise
};

/// The bytes that lifting takes for each value of a row or a column, on each thread: both halves of
/// it and their masks.
inline constexpr uint64_t kLiftingBytes = 8;

/// Undoes one level of the transform of a block, in place.
void inverseLevel(const WaveletSpec& spec, int level, const LevelBlock& block);

/// The fractions of the low part of a block, row by row: of its coefficients alone.
std::vector<uint8_t> lowFractions(const WaveletSpec& spec, int level, const LevelBlock& block);

}  // namespace tetrakis::inline wavelet
