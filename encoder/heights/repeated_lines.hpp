// SPDX-License-Identifier: Apache-2.0
// This file finds the columns and rows of heights that repeat the one before them.
#pragma once

#include <cstdint>

#include "encoder/inputs/coded_lines.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline heights {

/// Lines are taken to repeat others where runs of them are about as long everywhere, so that all
/// coded samples count alike: a sea in the first hundred rows is no reason to code one of them.
/// least: how many columns, and how many rows, are coded at least where there are as many.
CodedLines findRepeatedLines(const tks_heights& heights, uint32_t least);

}  // namespace tetrakis::inline heights
