// SPDX-License-Identifier: Apache-2.0
// textureStrips() cuts a view of a texture into strips of some rows where each strip can go on from
// the decoded tracks of the strip before. The planes of coefficients of a strip fit in caches, and
// a large image takes no plane of its size beside its texels.
#pragma once

#include <vector>

#include "api/decoder.hpp"

namespace tetrakis::inline api {

/// The strips of a view of the texture, from above; the view itself where it is decoded at once.
std::vector<View> textureStrips(const tks_decoder& decoder, const View& view);

}  // namespace tetrakis::inline api
