// SPDX-License-Identifier: Apache-2.0
// Reference decoder: how the sides of a forest are glued (docs/FORMAT.md, section 2, "Glue").
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tetrakis::reference {

/// Of each side the one that it is glued to, of a border itself; nothing where the codeword is
/// corrupt.
std::optional<std::vector<int>> readGlue(std::span<const uint8_t> codeword, int patches);

}  // namespace tetrakis::reference
