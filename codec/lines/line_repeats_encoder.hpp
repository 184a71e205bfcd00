// SPDX-License-Identifier: Apache-2.0
// encodeRepeats() codes the marks of the columns and rows that repeat the one before them, so that
// a header can state them.
#pragma once

#include <cstdint>
#include <vector>

#include "bitstream/stream/line_repeats.hpp"

namespace tetrakis::inline lines {

/// columns, rows: 1 where a line repeats the one before, 0 for the first.
LineRepeats encodeRepeats(std::vector<uint8_t> columns, std::vector<uint8_t> rows);

}  // namespace tetrakis::inline lines
