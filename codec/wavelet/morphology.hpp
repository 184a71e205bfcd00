// SPDX-License-Identifier: Apache-2.0
// liftedSamples() takes the mask of valid samples and returns the mask of those that are lifted:
// the valid ones and the bridges over narrow voids, which a closing of the mask adds.
#pragma once

#include <cstdint>
#include <vector>

#include "base/bit_plane.hpp"

namespace tetrakis::inline wavelet {

// opened() and closed() are the opening and closing of masks by squares (J. Serra, Image Analysis
// and Mathematical Morphology, 1982). Samples outside the plane count as marked in an erosion and
// as unmarked in a dilation, so that an opening takes marks away and a closing adds some, at the
// border too.

/// What squares cover that lie inside the mask, an erosion and then a dilation: bays, straits and
/// thin tongues go. marks: 0 or 1, of each sample of the plane. The squares have sides of 2 reach +
/// 1 samples. The time is that of a few passes over the plane, whatever the reach.
std::vector<uint8_t> opened(const std::vector<uint8_t>& marks, Extent plane, uint8_t reach);

/// The same of what is not marked, a dilation and then an erosion: holes and gaps are filled.
BitPlane closed(BitPlane marks, uint8_t reach);
/// What it takes beside the masks: strips of columns, and a row.
inline uint64_t closingBytes(Extent plane) {
  return 64 * (uint64_t{plane.height} + 256) + plane.width / 8 + 256;
}
std::vector<uint8_t> closed(const std::vector<uint8_t>& marks, Extent plane, uint8_t reach);

// liftedSamples() adds bridges to the mask of valid samples: voids in single holes and narrow gaps
// that have coefficients as samples have, and whose decoded values are thrown away. Lifting stops
// at voids, so such holes would cut a plane into pieces too short for its filters. The mask and a
// number in the stream header, the reach, tell which voids are bridged.

/// The reach that bridges every void.
inline constexpr uint8_t kBridgeAll = 255;

/// Returns the mask of the samples that are lifted: the closing of the valid ones by squares of
/// that reach. Nothing: all are. reach: 0 bridges nothing, kBridgeAll everything.
SharedBits liftedSamples(const SharedBits& valid, uint8_t reach);
std::vector<uint8_t> liftedSamples(const std::vector<uint8_t>& valid, Extent plane, uint8_t reach);

}  // namespace tetrakis::inline wavelet
