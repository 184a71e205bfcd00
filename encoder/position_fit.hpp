// SPDX-License-Identifier: Apache-2.0
// fitPositions() fits polynomials to the longitudes and latitudes of a raster, in as few bytes as a
// tolerance allows, so that a receiver without a library of projections knows where the raster
// lies. Maps are nearly similar to a plane that touches the sphere where they do, so that a few
// terms suffice; the error of the fit is counted in columns and rows.
#pragma once

#include <functional>
#include <optional>

#include "bitstream/stream/ground_positions.hpp"

namespace tetrakis::inline encoder {

/// Longitude and latitude of a place of a raster, u and v from -1 to 1; nothing if it has none.
using Locator = std::function<std::optional<LongitudeLatitude>(double u, double v)>;

struct PositionFit {
  double columns = 1, rows = 1;  ///< of the raster
  double tolerance = 0.1;        ///< the largest error, in samples
  size_t most_bytes = 0;
};

/// The shortest positions that meet the wish; nothing if none do.
std::optional<GroundPositions> fitPositions(const Locator& locate, const PositionFit& wish);

}  // namespace tetrakis::inline encoder
