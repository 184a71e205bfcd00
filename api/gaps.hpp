// SPDX-License-Identifier: Apache-2.0
// headerFor() and heightTracksFor() say which tracks count for a view of a decoder whose bytes have
// gaps: only those that the view needs have to be there. A view whose tracks are complete is
// decoded as it would be from the complete stream. Corrections of a region are left out while
// coefficients are missing somewhere, because they belong to other heights. A decoder without gaps
// uses all tracks.
#pragma once

#include "api/decoder.hpp"

namespace tetrakis::inline api {

/// The header of a component: what is missing of tracks that the view does not need counts as
/// there, so that the heights or texels are rounded (docs/FORMAT.md, section 7).
GeometryHeader headerFor(const tks_decoder& decoder, const GeometryHeader& header,
                         const View& view);
TextureHeader headerFor(const tks_decoder& decoder, const TextureHeader& header, const View& view);

/// The tracks of the heights: corrections of a region are empty unless all coefficients are there
/// that reach into it, because corrections of other heights correct nothing.
Codewords heightTracksFor(const tks_decoder& decoder, const View& view);

}  // namespace tetrakis::inline api
