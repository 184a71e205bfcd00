// SPDX-License-Identifier: Apache-2.0
// Adds the corrections of heights to what coefficients or a drawing give.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline geometry {

/// What has to be decoded so that the samples of a view of the coded lines can be corrected: whole
/// parts of the plane (bitstream/stream/correction_tracks.hpp), or, of a plane in one track, all
/// rows up to the last one.
View correctedView(const GeometryHeader& header, const GeometryLayers& layers, const View& view);

/// The heights with their corrections. decoded: what correctedView() says, of level 0. codewords:
/// any prefix of the one of each part. threads: nothing depends on them. Safe on any bytes.
DecodedHeights corrected(DecodedHeights decoded, const GeometryHeader& header,
                         const GeometryLayers& layers,
                         const std::vector<std::span<const uint8_t>>& codewords, const View& view,
                         uint32_t threads);

/// The window of heights of a larger view, without its marks of vertices where it has none.
DecodedHeights windowOf(const DecodedHeights& decoded, const Window& window);

/// Returns the hints (codec/geometry/corrections/corrections_pass.hpp) of corrections of steps: how
/// many of a vertex and its four neighbours are significant. significant: of the samples of a part.
std::vector<uint8_t> activityHints(std::span<const uint8_t> significant, Extent extent);

}  // namespace tetrakis::inline geometry
