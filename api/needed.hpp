// SPDX-License-Identifier: Apache-2.0
// A view needs only some tracks of a stream: neededTracks() lists them, and headerFor() and
// heightTracksFor() take those that are there of a stream whose bytes have gaps. giveRanges() tells
// callers which ranges of bytes are missing.
#pragma once

#include <span>
#include <vector>

#include "api/decoder.hpp"
#include "base/view.hpp"
#include "bitstream/stream/header.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

// neededTracks() lists the tracks of a component that a view of it needs.

/// For each track, by its number, whether the view needs it. view: of the lines that are shown.
std::vector<bool> neededTracks(const StreamHeader& header, Component component, const View& view);

// giveRanges() copies ranges of bytes into a list that the caller releases.

/// Copies ranges to where tks_free_ranges() finds them. out: has none.
void giveRanges(std::span<const tks_range> ranges, tks_ranges& out);

// headerFor() and heightTracksFor() say which tracks count for a view of a decoder whose bytes have
// gaps: only those that the view needs have to be there. A view whose tracks are complete is
// decoded as it would be from the complete stream. Corrections of a region are left out while
// coefficients are missing somewhere, because they belong to other heights. A decoder without gaps
// uses all tracks.

/// The header of a component: what is missing of tracks that the view does not need counts as
/// there, so that the heights or texels are rounded (docs/FORMAT.md, section 7).
GeometryHeader headerFor(const tks_decoder& decoder, const GeometryHeader& header,
                         const View& view);
TextureHeader headerFor(const tks_decoder& decoder, const TextureHeader& header, const View& view);

/// The tracks of the heights: corrections of a region are empty unless all coefficients are there
/// that reach into it, because corrections of other heights correct nothing.
Codewords heightTracksFor(tks_decoder& decoder, const View& view);

}  // namespace tetrakis::inline api
