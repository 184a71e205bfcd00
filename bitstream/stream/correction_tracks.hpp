// SPDX-License-Identifier: Apache-2.0
// The functions here number the tracks that hold the corrections of heights. Corrections of a plane
// in one track follow its coefficients. Corrections of a plane in regions are tracks of their own
// behind the tracks of coefficients, one for each region of the finest levels, so that a window is
// decoded without the corrections of other regions.
#pragma once

#include <cstdint>
#include <vector>

#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/track/regions.hpp"

namespace tetrakis::inline stream {

/// How many tracks of coefficients there are.
inline uint64_t coefficientTracks(const GeometryHeader& header) {
  return regionCount(header.width, header.height, header.regions.side_log2);
}

/// How many tracks of corrections there are.
inline uint64_t correctionTracks(const GeometryHeader& header, const GeometryLayers& layers) {
  if (layers.corrections == CorrectionKind::kNone) return 0;
  return finestRegionCount(header.width, header.height, header.regions.side_log2);
}

/// The rectangles of the plane whose corrections are a codeword each, in the order of the tracks;
/// without such tracks the whole plane.
inline std::vector<Window> correctionParts(Extent plane, int region_log2) {
  std::vector<Window> parts = finestRegions(plane.width, plane.height, region_log2);
  if (parts.empty()) parts.push_back({0, 0, plane.width, plane.height});
  return parts;
}

}  // namespace tetrakis::inline stream
