// SPDX-License-Identifier: Apache-2.0
// The header of a component as it counts for a view: only the tracks that the view needs have to be
// there.
#pragma once

#include "api/decoder.hpp"

namespace tetrakis::inline api {

/// The header of a component for a decoder whose bytes have gaps: what is missing of tracks that
/// the view does not need counts as there. So a view whose tracks are complete is decoded as it
/// would be of the complete stream, rounding included (docs/FORMAT.md, section 7). Other decoders
/// get the header as it is.
GeometryHeader headerFor(const tks_decoder& decoder, const GeometryHeader& header,
                         const View& view);
TextureHeader headerFor(const tks_decoder& decoder, const TextureHeader& header, const View& view);

}  // namespace tetrakis::inline api
