// SPDX-License-Identifier: Apache-2.0
// chooseWavelet() takes a plane and the purpose of its stream and returns the filters that suit it;
// roundedBytes() returns the prefix from which on decoders round. Both stand in the stream's
// header, so that decoders need not know how they were chosen. Encoder only.
#pragma once

#include <cstdint>
#include <span>

#include "base/plane.hpp"
#include "bitstream/stream/coding_headers.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/wavelet/pyramid.hpp"

namespace tetrakis::inline choice {

// chooseWavelet() chooses the filters that suit a plane, chooseLosslessWavelet() those of an image
// that is coded to the last bit.

/// What a plane is coded for.
enum class Purpose : uint8_t {
  kLossless,  ///< the last bit: no fraction bits
  kLossy      ///< something short of it: as many fraction bits as rounding noise asks for
};

/// Bits of samples with fraction bits, at most; wider samples have none. With a larger number the
/// low bands of kOrthogonal pass 2^30; with a smaller one wide samples lose by roundings.
inline constexpr int kBitsWithFractions = 20;

/// What the filters of lossy streams are chosen for.
struct RateTarget {
  double bits = 0;         ///< a sample that there are for the plane; 0: any
  double mean_square = 0;  ///< error of a sample of the plane that is wanted; 0: any
};

/// Chooses the filters of heights, or of a lossy texture by one plane of it. They are tried on
/// typical parts of the plane, whose samples have `bits` bits, and compared by an estimate of the
/// bits that their coefficients take, at a step that suits most streams and at a finer one where
/// the target asks for it.
WaveletHeader chooseWavelet(const PlaneView<const int32_t>& plane, int bits, Purpose purpose,
                            const RateTarget& target = {});

/// Chooses the wavelet of a plane of which samples are held.
WaveletHeader chooseWavelet(const PlaneView<const int32_t>& plane, const HeldSamples& held,
                            int bits, Purpose purpose, const RateTarget& target = {});

/// Chooses the same filters for all planes of an image that is coded to the last bit.
WaveletHeader chooseLosslessWavelet(std::span<const PlaneView<const int32_t>> planes, int bits);

/// Whether the plane has no roughness, by the filter that was chosen for it.
bool suitsSmoothGround(const WaveletHeader& chosen);

/// A choice for streams of which windows will be read: the filter of the coarse levels is the
/// shortest. Each level doubles what its filter reaches, so that they pull in most of the regions
/// around a window, and hold few of the bytes.
WaveletHeader withShortReach(WaveletHeader chosen);

/// The filters of a lossy choice, for the last bit.
WaveletHeader withoutFraction(WaveletHeader lossy);

/// About how many bits the coefficients of a plane take that is coded to the last bit.
double losslessBits(const PlaneView<const int32_t>& plane, int bits);

// roundedSquares() and roundedBytes() choose the prefix from which on decoders round while they
// invert the transform of a lossless stream (docs/FORMAT.md, section 7). Near the last bit rounding
// takes the roundings of the encoder back; before, it adds errors of its own.

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
