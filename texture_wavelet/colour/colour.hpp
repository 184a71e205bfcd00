// SPDX-License-Identifier: Apache-2.0
// The colour transform is reversible: it consists of three integer shears
// (P. Hao, Q. Shi, "Matrix factorizations for reversible integer mapping", IEEE TSP 49(10), 2001).
//
// Channels r, g, b become the colour planes c0 (luma), c1, c2 in the order kChannelOrders[order];
// then
//
//   c1 += round((shears[0] c2 + shears[1] c0) / 128)
//   c2 += round((shears[2] c1 + shears[3] c0) / 128)
//   c0 += round((shears[4] c1 + shears[5] c2) / 128)
//
// which is exactly invertible whatever the rounding. Six numbers are as many as three directions of
// colour space have degrees of freedom: every rotation is reached up to the lengths of its rows.
// These come out near those of the differences and the mean that lossless coders use: each
// plane is rounded once, and grey texels have no chroma. Bytes against a rotation of unit rows
// (four shears): lossless -8 %, lossy +0.6 %.
//
// A further colour, which is the last of 2 or 4 channels, such as near infrared, follows the planes
// before it: cn += round((k0 c0 + k1 c1 + k2 c2) / 128). Alpha follows none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "codec/wavelet/synthesis/view_synthesis.hpp"

namespace tetrakis::inline colour {

inline constexpr int kShearFractionBits = 7;
inline constexpr std::array<std::array<uint8_t, 3>, 6> kChannelOrders = {
    {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};

/// Six shears in units of 2^-kShearFractionBits; if all are 0 they change nothing.
using Shears = std::array<int16_t, 6>;

/// Parameters of the transform, as they stand in the stream header. Every value is legal.
struct ColourTransform {
  std::array<uint16_t, 4> centre{};  ///< subtracted from each channel
  uint8_t order = 0;                 ///< index into kChannelOrders, taken modulo 6
  Shears shears{};                   ///< of samples
  /// Further shears of coefficients: [i] of level i + 2, the last one of all coarser levels and of
  /// the low band.
  std::vector<Shears> level_shears;
  /// What the last of 2 or 4 planes follows those before it by, in the same unit.
  std::array<int16_t, 3> further_shears{};

  static constexpr size_t kMostLevelShears = 7;
};

/// Channels to colour planes, in place. planes: 1 (grey), 2 (grey, alpha or a further colour), 3
/// (RGB) or 4 distinct planes of `count` values. Alpha is only centred. The colour planes come with
/// fraction_bits (0 to 8) binary places. inverseShears() and restoreSamples() undo it exactly.
/// Arithmetic wraps modulo 2^32; transforms of fitColour and RGB of at most 18 bits with the
/// fraction stay clear of it.
void forwardColour(const ColourTransform& transform, std::span<int32_t* const> planes, size_t count,
                   int fraction_bits);

/// Colour planes to channels, in place, which keep their fraction and miss their centres. Defined
/// for all values.
void inverseShears(const ColourTransform& transform, std::span<int32_t* const> planes,
                   size_t count);

/// Rounds the fraction_bits (0 to 8) binary places off a channel, in place, after the shears: lossy
/// reconstructions gain by them (wavelet.hpp). Then it adds the centre. Defined for all values; the
/// caller clamps the result to the range of its samples.
void restoreSamples(std::span<int32_t> channel, uint16_t centre, int fraction_bits);

/// Shears the coefficients of one level, in place: three planes of `count` values. Sums are
/// of 64 bits, because low bands outgrow samples. Exactly undone by inverseLevelColour.
void forwardLevelColour(const ColourTransform& transform, int level,
                        std::span<int32_t* const> planes, size_t count);
void inverseLevelColour(const ColourTransform& transform, int level,
                        std::span<int32_t* const> planes, size_t count);

/// Samples that go through the transform together: few enough for the cache.
inline constexpr size_t kColourChunk = 2048;

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// The linear version of the shears: plane i = sum_j matrix[i][j] * (channel j - centre[j]),
/// for coefficients of a level (level 1: for samples too).
Matrix3 colourMatrix(const ColourTransform& transform, int level = 1);

/// Squared RGB error, summed over the three channels, for a unit squared error in each plane of a
/// level's coefficients. weights: what the squared error of each channel counts.
std::array<double, 3> planeEnergies(const ColourTransform& transform, int level = 1,
                                    const std::array<double, 3>& weights = {1, 1, 1});

/// Squared error of the last of `planes` channels for a unit squared error in each plane before it.
std::array<double, 3> furtherEnergies(const ColourTransform& transform, size_t planes, int level);

// forwardColourLevels() and inverseColourLevels() turn the colour planes of each level by the
// shears of that level. Photographs out of a camera or a JPEG file have grey details, because
// chroma was sampled or kept at half the resolution, while their coarse shapes follow the colours
// of the ground: one rotation cannot suit both.

/// Turns the colour planes of every level, in place. planes: the coefficients of 3 or more
/// transformed planes of that pyramid. Fewer planes are left alone.
void forwardColourLevels(const ColourTransform& transform, const Pyramid& pyramid,
                         std::span<int32_t* const> planes);

/// Turns them back, as far as views of the planes need them. planes: 3 or more of one view of that
/// pyramid, of which every coefficient is put. Fewer are left alone.
void inverseColourLevels(const ColourTransform& transform, const Pyramid& pyramid,
                         std::span<ViewSynthesis> planes);

}  // namespace tetrakis::inline colour
