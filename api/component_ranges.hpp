// SPDX-License-Identifier: Apache-2.0
// componentRanges() tells how large the samples of each component of a stream are, so that errors
// of heights and of texels can be weighed against each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "encoder/combination/combined_part.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

/// By the numbers of the components; of unknown ones without an error. It decodes a level of at
/// most 2^16 samples of each. The statuses are those of tks_open and of the calls that decode.
Result<std::vector<ComponentRange>> componentRanges(std::span<const uint8_t> stream,
                                                    const tks_limits* limits);

}  // namespace tetrakis::inline api
