// SPDX-License-Identifier: Apache-2.0
// flatCorner() lays a triangle down on a texture, of which two corners lie there already, so that
// its angles stay the same.
#pragma once

#include <array>
#include <cstdint>

#include "codec/trianglemesh/coded_triangles.hpp"

namespace tetrakis::inline trianglemesh {

/// Above 0 if a, b, c turn from the first axis to the second one, below 0 if the other way.
inline int64_t turnOf(const Texcoord& a, const Texcoord& b, const Texcoord& c) {
  return int64_t{b[0] - a[0]} * (c[1] - a[1]) - int64_t{b[1] - a[1]} * (c[0] - a[0]);
}

/// Where the third corner lies if the first two lie at `flat`, whose numbers are below 2^24 as
/// those of `places`. The three turn from the first axis to the second one, or the other way if
/// is_mirrored. Where the first two are one place, or next to it, it lies at the first one.
Texcoord flatCorner(const std::array<Place, 3>& places, const std::array<Texcoord, 2>& flat,
                    bool is_mirrored);

}  // namespace tetrakis::inline trianglemesh
