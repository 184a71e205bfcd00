// SPDX-License-Identifier: Apache-2.0
// What counts for a view of a decoder whose bytes have gaps: only the tracks that the view needs
// have to be there. So a view whose tracks are complete is decoded as it would be of the complete
// stream. Decoders without gaps get everything as it is.
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
