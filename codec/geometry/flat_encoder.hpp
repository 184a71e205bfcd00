// SPDX-License-Identifier: Apache-2.0
// Finds flat areas, and codes them.
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "codec/geometry/flat_areas.hpp"

namespace tetrakis::inline geometry {

/// The areas of at least so many valid samples of one height, without those samples of smaller ones
/// that touch larger ones of another level. None if there is no such area.
FlatAreas findFlatAreas(const PlaneView<const int32_t>& heights, uint32_t least);

/// valid: the samples that are not void. There are areas.
std::vector<uint8_t> encodeFlatAreas(const FlatAreas& areas, Extent plane, Mask valid);

}  // namespace tetrakis::inline geometry
