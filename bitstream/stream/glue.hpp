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

/// (Encoder) where a FaceWalk meets a face, and by which side it enters it: numbered and turned
/// like this faces take the fewest bits.
struct MetFace {
  uint32_t face = 0;
  uint32_t entered = 0;  ///< a side of it; of the first face of a component 0
};

/// (Encoder) one for each face, in the order of the walk, whose components begin at their lowest
/// faces. of_face: sides of each.
std::vector<MetFace> facesAsMet(const std::vector<uint32_t>& sides, uint32_t of_face);

}  // namespace tetrakis::inline stream
