// SPDX-License-Identifier: Apache-2.0
// encodeGlue() and decodeGlue() turn the sides of a forest into a codeword and back: glue_pass.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/forest.hpp"

namespace tetrakis::inline stream {

/// (Encoder) sides: of a sound forest.
std::string encodeGlue(const std::vector<uint32_t>& sides);

/// Sides that are sound (Forest::isSound()), or nothing where the codeword breaks a rule or ends
/// early. patches: at least 1. Takes some twenty decisions a patch.
std::optional<std::vector<uint32_t>> decodeGlue(std::string_view codeword, uint32_t patches);

/// (Encoder) where a ForestWalk meets the patches of a forest, and by which side it enters them:
/// numbered and turned like this they take the fewest bits.
struct MetPatch {
  uint32_t patch = 0;
  uint32_t entered = 0;  ///< the side, 0 to 3; of the first patch of a component 0
};

/// One for each patch, in the order of the walk, whose components begin at their lowest patches.
std::vector<MetPatch> patchesAsMet(const std::vector<uint32_t>& sides);

}  // namespace tetrakis::inline stream
