// SPDX-License-Identifier: Apache-2.0
// decodeEngineHeights() decodes heights from a stream for a game engine, and engineText() lists the
// numbers that its user types in there.
#pragma once

#include <string>

#include "apps/tools/files/engine_heights.hpp"
#include "apps/tools/files/stream.hpp"
#include "apps/tools/output/json.hpp"

namespace tetrakis::tools {

/// From the mip level that is just finer than the square. Leaves the decoder at level 0.
Result<EngineHeights> decodeEngineHeights(Decoder& decoder, const EngineSize& size,
                                          uint64_t copies);

/// Size, range and the engine's own scales.
Json engineJson(const EngineHeights& heights);

/// A sentence or two for people.
std::string engineText(const EngineHeights& heights);

}  // namespace tetrakis::tools
