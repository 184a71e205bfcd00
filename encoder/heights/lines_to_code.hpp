// SPDX-License-Identifier: Apache-2.0
// This file finds the columns and rows of heights that repeat the one before them.
#pragma once

#include "encoder/inputs/coded_lines.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline heights {

/// The lines to code; none where all are. A judge of pictures takes whole heights. A PSNR is that
/// of all samples, of which those of long runs count more: with voids nobody knows by how much.
/// Small budgets have no bytes for a long map.
CodedLines linesToCode(const EncodeInputs& inputs);

}  // namespace tetrakis::inline heights
