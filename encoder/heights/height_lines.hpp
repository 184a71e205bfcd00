// SPDX-License-Identifier: Apache-2.0
// heightLines() finds the columns and rows of the input heights that repeat the one before them, so
// that only the other lines are coded (encoder/inputs/repeated_lines.hpp).
#pragma once

#include "encoder/inputs/coded_lines.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline heights {

/// The lines of the heights to code; none where all are. A PSNR counts all samples, so for a PSNR
/// all lines are coded if runs differ clearly in length, or beside voids, where nobody knows by how
/// much a run counts.
CodedLines heightLines(const EncodeInputs& inputs);

}  // namespace tetrakis::inline heights
