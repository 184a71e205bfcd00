// SPDX-License-Identifier: Apache-2.0
// opened() and closed() are the opening and closing of masks by squares (J. Serra, Image Analysis
// and Mathematical Morphology, 1982). Samples outside the plane count as marked in an erosion and
// as unmarked in a dilation, so that an opening takes marks away and a closing adds some, at the
// border too.
#pragma once

#include <cstdint>
#include <vector>

#include "base/bit_plane.hpp"

namespace tetrakis::inline wavelet {

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

}  // namespace tetrakis::inline wavelet
