// SPDX-License-Identifier: Apache-2.0
// takeRegionMasks() takes the masks of regions off their tracks, and decodeRegionMasks() puts the
// mask of a plane together from them. So a window is decoded without the mask of the rest, and
// nobody who codes or decodes a plane has to hold the mask of all of it.
//
// The mask is that of the whole plane (docs/FORMAT.md, section 5.3). The first track says which
// samples of the lowest band of the groups exist, and each region adds the samples that its three
// levels add, as ValidityPass codes them above a lattice that is known: the plane of group g has
// every 8^g-th sample of every 8^g-th row. A region knows of no neighbour.
#pragma once

#include <cstdint>
#include <vector>

#include "base/sample_marks.hpp"
#include "base/view.hpp"
#include "codec/geometry/plane_corrections.hpp"

namespace tetrakis::inline geometry {

/// Takes the masks off the front of all tracks of coefficients but the first. Each has its length
/// before it; where that is not whole, or is none, the track holds nothing. Safe on any bytes.
void takeRegionMasks(TakenLayers& taken);

/// As much of the mask as decoding a view reads. Samples of which no byte tells are taken to be as
/// most of those around them. taken: of heights with region masks. Safe on any bytes.
SampleMarks decodeRegionMasks(const TakenLayers& taken, const View& view);

/// What decoding and keeping that mask takes.
uint64_t regionMaskBytes(const GeometryHeader& header, const View& view);

/// Marks the tracks that the masks of marked ones stand on. needed: of each track of coefficients.
void addMaskTracks(const GeometryHeader& header, std::vector<bool>& needed);

}  // namespace tetrakis::inline geometry
