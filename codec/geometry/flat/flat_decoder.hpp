// SPDX-License-Identifier: Apache-2.0
// decodeFlatAreas() decodes the layer of flat areas (flat_pass.hpp).
#pragma once

#include <cstdint>
#include <span>

#include "base/bit_plane.hpp"
#include "codec/geometry/flat/flat_areas.hpp"

namespace tetrakis::inline flat {

/// codeword: any prefix of that of a plane with so many areas and these valid samples. There are
/// none unless every decision counts and the areas are so many. Safe on any bytes.
FlatAreas decodeFlatAreas(std::span<const uint8_t> codeword, Extent plane, const SharedBits& valid,
                          uint32_t areas);

}  // namespace tetrakis::inline flat
