// SPDX-License-Identifier: Apache-2.0
// chooseLosslessColour() chooses the colour transform of an image that is coded to the last bit. It
// takes the axes of lossy streams where these cost about as few bytes as the cheapest ones, because
// prefixes of a lossless stream are lossy. Encoder only.
#pragma once

#include <cstdint>
#include <span>

#include "base/plane.hpp"
#include "texture_wavelet/colour/colour.hpp"

namespace tetrakis::inline colour {

/// A rotation that packs the energy is best at low rates; the last bits are noise, which it spreads
/// over all planes. Takes the cheapest, by the residuals of a gradient predictor, of the
/// fitted rotations (colour_axes.hpp), JPEG 2000's reversible transform about each channel, and
/// none; but the colours of lossy streams, which are better for prefixes, where these cost about as
/// little. channels: 1 to 4 of that extent, as in fitColour.
ColourTransform chooseLosslessColour(std::span<const int32_t* const> channels, Extent extent);

}  // namespace tetrakis::inline colour
