// SPDX-License-Identifier: Apache-2.0
// decodeFlatAreas() decodes the layer of flat areas (flat_pass.hpp).
#pragma once

#include <cstdint>
#include <span>

#include "base/bit_plane.hpp"
#include "codec/geometry/flat/flat_areas.hpp"

namespace tetrakis::inline flat {

/// codeword: any prefix of the codeword of a plane with this number of areas and these valid
/// samples. The result has no areas unless every decision counts and the number of areas is right.
/// Safe on any bytes.
FlatAreas decodeFlatAreas(std::span<const uint8_t> codeword, Extent plane, const SharedBits& valid,
                          uint32_t areas);

}  // namespace tetrakis::inline flat
