// SPDX-License-Identifier: Apache-2.0
// corrected() adds the corrections of a plane, or of its regions, to the heights that coefficients
// or a drawing give.
#pragma once

#include <cstdint>

#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/taken_layers.hpp"

namespace tetrakis::inline geometry {

/// The view that has to be decoded so that the samples of a view of the coded lines can be
/// corrected: whole parts of the plane (bitstream/stream/correction_tracks.hpp), or, in a plane in
/// one track, all rows up to the last one.
View correctedView(const GeometryHeader& header, const GeometryLayers& layers, const View& view);

/// The heights with their corrections. decoded: of the view correctedView(), at level 0. threads:
/// nothing depends on them. Safe on any bytes.
DecodedHeights corrected(DecodedHeights decoded, const TakenLayers& taken, const View& view,
                         uint32_t threads);

/// The heights of a window, cut out of a larger view. They have no marks of vertices if the view
/// has none.
DecodedHeights windowOf(const DecodedHeights& decoded, const Window& window);

}  // namespace tetrakis::inline geometry
