// SPDX-License-Identifier: Apache-2.0
// Reference decoder: how the sides of faces are glued (docs/FORMAT.md, section 2, "Glue").
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "conformance/reference_decoder/range_decoder.hpp"

namespace tetrakis::reference {

/// Of each side the one that it is glued to, of a border itself; nothing where the codeword is
/// corrupt. sides: of each face.
std::optional<std::vector<int>> readGlue(RangeDecoder& decoder, int faces, int sides);

}  // namespace tetrakis::reference
