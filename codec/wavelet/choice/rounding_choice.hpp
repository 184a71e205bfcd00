// SPDX-License-Identifier: Apache-2.0
// roundedSquares() and roundedBytes() choose the prefix from which on decoders round while they
// invert the transform of a lossless stream (docs/FORMAT.md, section 7). Near the last bit rounding
// takes the roundings of the encoder back; before, it adds errors of its own. Encoder only.
#pragma once

#include <cstdint>
#include <span>

#include "base/plane.hpp"
#include "bitstream/stream/coding_headers.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/wavelet/held_samples.hpp"

namespace tetrakis::inline choice {

/// The squares that coefficients may still be off by for the inverse to be better with roundings
/// than without; 0: none. Measured on typical parts of the plane. wavelet: without fraction bits.
double roundedSquares(const PlaneView<const int32_t>& plane, const HeldSamples& held,
                      const WaveletHeader& wavelet);

/// The points of a track's coefficients (EncodedTrack::points).
using Account = std::vector<RatePoint>;

std::vector<Account> accountsOf(std::span<const EncodedTrack> tracks);

/// Returns WaveletHeader::rounded_bytes. accounts: of all tracks of a component, which are
/// complete. squares: of them together.
uint64_t roundedBytes(std::span<const Account> accounts, double squares);

/// The bytes from which on tracks of coefficients alone are rounded; those that are not complete
/// never are.
uint64_t roundedBytes(std::span<const EncodedTrack> tracks, double squares);

}  // namespace tetrakis::inline choice
