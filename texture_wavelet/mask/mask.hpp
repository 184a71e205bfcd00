// SPDX-License-Identifier: Apache-2.0
// cutoutOf() and photographOf() take an image and return the mask of the texels that the wavelet
// has to code: those that are opaque, and those over which nothing is drawn. Encoder only.
#pragma once

#include <cstdint>
#include <vector>

#include "base/samples.hpp"

namespace tetrakis::inline mask {

// cutoutOf() tells the mask of a cut-out: an image of which every texel is either opaque or absent,
// such as a sign, a tree or a coast. Its alpha is coded as a mask, exact before the first colour.
// Hidden colours are coded only in lossless streams; in others they come back as the mean colour.

/// Returns one byte for each texel, which is 1 where alpha has the largest value and 0 where it is
/// 0; or nothing if alpha has any other value, or the largest one everywhere.
std::vector<uint8_t> cutoutOf(const Texels& texels);

/// Returns one byte for each texel, which is 0 where alpha is 0; or nothing if it is 0 nowhere, or
/// if the image is a cut-out.
std::vector<uint8_t> softlySeen(const Texels& texels);

/// Gives texels that are not coded the mean colour of those that are, or 0 if there are none.
/// channels: the colours.
std::vector<std::vector<int32_t>> withMeanColour(Mask coded,
                                                 std::vector<std::vector<int32_t>> channels);

/// Returns how many samples count in errors: all alphas, and the colours of texels that are seen.
uint64_t countedSamples(const Texels& texels, Mask seen);

/// Returns the sum of the squared errors of the samples that count. Both images have the same
/// shape.
double countedSquares(const Texels& original, const Texels& decoded, Mask seen);

// photographOf() separates a photograph from an overlay that somebody has drawn over it: lettering,
// boundaries, borders without data, water in one colour. A wavelet rings along all edges of an
// overlay; so its texels are drawn, and the wavelet lifts around them as around voids. An overlay
// lies ahead of all coefficients, so it has to save more bytes than prefixes lose by it.

/// Returns one byte for each texel, which is 1 if it belongs to the photograph and 0 if it belongs
/// to the overlay; or nothing if no overlay is worth trying. Each colour of an overlay fills at
/// least 1/2000 of the texels, and half of those are like the texel before, or three quarters like
/// that or the one above. seen: the texels whose colours matter; an overlay need not draw the
/// others.
std::vector<uint8_t> photographOf(const Texels& texels, Mask seen = {});

}  // namespace tetrakis::inline mask
