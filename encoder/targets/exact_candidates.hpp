// SPDX-License-Identifier: Apache-2.0
// exactHeights(), exactTexture() and exactWays() make candidates of one component that end exact
// within a byte budget, to be held against the lossy candidate that the encoder makes first.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "encoder/heights/ways/facet_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/targets/candidates.hpp"

namespace tetrakis::inline targets {

/// The ways in which neighbours restore samples that are on no grid of steps.
struct ByNeighbours {
  double relative_step = 0;  ///< in sample units; 0: none
  std::optional<FacetShare> facets = {};

  /// lossy: the heights, if there are any. room: bytes for them.
  ByNeighbours(const HeightsCandidate& lossy, uint64_t room);
};

/// The heights to the last bit in fewer than `room` bytes, if their prefixes are as good as those
/// of the lossy heights. Where samples are on no grid, the way of fewer bytes is taken.
std::optional<HeightsCandidate> exactHeights(const EncodeInputs& inputs,
                                             const HeightsCandidate& lossy,
                                             const ByNeighbours& neighbours, uint64_t room);

/// The texture to the last bit, under the same conditions. Drawn and stored textures are lossless
/// as they stand, but tables of values may take fewer bytes; where these leave half of the budget,
/// prefixes do not matter.
std::optional<TextureCandidate> exactTexture(const EncodeInputs& inputs,
                                             const TextureCandidate& lossy, uint64_t room);

/// All ways to code heights to the last bit in fewer bytes than the budget whose prefixes are as
/// good as those of the lossy heights, which have a curve. Coefficients of a cut are those of the
/// lossy heights, unless only the lossless way fits.
std::vector<HeightsCandidate> exactWays(const EncodeInputs& inputs, const HeightsCandidate& lossy,
                                        const ByNeighbours& neighbours);

}  // namespace tetrakis::inline targets
