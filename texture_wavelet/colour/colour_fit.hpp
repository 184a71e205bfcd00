// SPDX-License-Identifier: Apache-2.0
// fitColour() takes the channels of an image and returns the colour transform with which they take
// the fewest bits: its axes are those of the details of the image. turnLevels() fits further shears
// to single levels, chooseLosslessColour() and fitFurtherColour() fit what lossless images and a
// fourth channel need. Encoder only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "texture_wavelet/colour/colour.hpp"

namespace tetrakis::inline colour {

// sampleDetails() samples the orthonormal Haar details of an image at all scales, to which the axes
// of colour are fitted.

using Colour = std::array<float, 3>;

/// Details of one scale.
struct ColourDetails {
  std::array<std::vector<float>, 3> channels;  ///< of each detail
  double weight = 1;                           ///< coefficients of the image that each stands for

  size_t count() const { return channels[0].size(); }
  void add(const Colour& detail) {
    for (size_t k = 0; k < detail.size(); ++k) channels[k].push_back(detail[k]);
  }
};

/// [i]: of level i + 1, some thousands at most. channels: 3 or more of that extent. Empty where the
/// image has less than two rows or columns.
std::vector<ColourDetails> sampleDetails(std::span<const int32_t* const> channels, Extent extent);

/// The magnitude that a tenth of all coefficients of the channels exceed: about the step at middle
/// rates.
double typicalStep(std::span<const ColourDetails> details);

/// Estimated bits of all coefficients along one axis, a unit vector: log2(1 + |c| / step) each.
double bitsAlong(const std::array<double, 3>& axis, const ColourDetails& details, double step);

// fitAxes() finds the axes of colour along which an image is cheapest to code: a coefficient c at a
// step T costs about log2(1 + |c| / T) bits, and the axes are turned by small rotations until the
// sum of these costs is least.

/// Axes of colour that need the fewest bits: rows of rotations, luma first.
struct ColourAxes {
  std::vector<ColourDetails> details;  ///< empty: the image is too small to have any
  Matrix3 overall;                     ///< for all scales, each counting as much
  std::vector<Matrix3> levels;         ///< [i]: for level i + 1; as many as details
};

/// Fits axes to 3 or more channels of that extent.
ColourAxes fitAxes(std::span<const int32_t* const> channels, Extent extent, Purpose purpose);

// turnLevels() chooses the shears of the coefficients of each level, where they save more bits than
// they take in the header.

/// A transform, and the bits that coefficients and header are estimated to take with it.
struct TurnedLevels {
  ColourTransform transform;
  double bits;
};

/// Turns the colour planes of as many levels as that pays for: those of level i + 1 towards the
/// rows of axes.levels[i]. transform: has no shears of levels.
TurnedLevels turnLevels(const ColourTransform& transform, const ColourAxes& axes, double step);

// fitColour() fits the colour transform to the channels of an image.

/// Centres every channel on its mean and fits the shears of RGB to the image. channels: 1 to 4 of
/// that many samples of at most 16 bits, as in forwardColour.
ColourTransform fitColour(std::span<const int32_t* const> channels, Extent extent);

/// Only centres every channel on its mean.
ColourTransform centred(std::span<const int32_t* const> channels, size_t count);

/// Takes the order and the shears with which the colour planes point along the rows of a rotation
/// (an orthogonal matrix), row 0 first, rows 1 and 2 in either order: the smallest shears possible.
ColourTransform rotated(ColourTransform transform, const Matrix3& rotation);

// chooseLosslessColour() chooses the colour transform of an image that is coded to the last bit. It
// takes the axes of lossy streams where these cost about as few bytes as the cheapest ones, because
// prefixes of a lossless stream are lossy.

/// A rotation that packs the energy is best at low rates; the last bits are noise, which it spreads
/// over all planes. Takes the cheapest, by the residuals of a gradient predictor, of the fitted
/// rotations, JPEG 2000's reversible transform about each channel, and none; but the colours of
/// lossy streams, which are better for prefixes, where these cost about as little. channels: 1 to 4
/// of that extent, as in fitColour.
ColourTransform chooseLosslessColour(std::span<const int32_t* const> channels, Extent extent);

// fitFurtherColour() finds how a further colour, such as near infrared, follows from the other
// channels.

/// ColourTransform::further_shears for channels of which the last, of 2 or 4, is a further colour.
/// transform: that of the others.
std::array<int16_t, 3> fitFurtherColour(const ColourTransform& transform,
                                        std::span<const int32_t* const> channels, Extent extent,
                                        Purpose purpose);

}  // namespace tetrakis::inline colour
