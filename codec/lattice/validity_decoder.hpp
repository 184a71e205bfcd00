// SPDX-License-Identifier: Apache-2.0
// decodeValidity() decodes any prefix of the codeword of a mask to the samples that are valid.
#pragma once

#include <cstdint>
#include <span>

#include "base/bit_plane.hpp"

namespace tetrakis::inline lattice {

/// What decoding a mask takes at most, the mask itself included: before its last lattice is joined.
inline uint64_t validityBytes(Extent plane) {
  return BitPlane::bytesOf(plane) +
         4 * BitPlane::bytesOf({plane.width / 2 + 1, plane.height / 2 + 1});
}

/// Returns which samples of the plane are valid; the others are void. codeword: any prefix of a
/// validity codeword; an empty one says that every sample is valid. Safe on any bytes.
BitPlane decodeValidity(std::span<const uint8_t> codeword, Extent plane);

/// The same of a mask that comes late, when it is known which samples are lifted: all others are
/// void. Lifted samples of which the codeword does not tell are taken to be valid.
BitPlane decodeLateValidity(std::span<const uint8_t> codeword, Extent plane,
                            const SharedBits& lifted);

}  // namespace tetrakis::inline lattice
