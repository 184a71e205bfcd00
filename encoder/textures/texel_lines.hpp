// SPDX-License-Identifier: Apache-2.0
// texelLines() finds the columns and rows of the input image that repeat the one before them, so
// that only the other lines are coded (encoder/inputs/repeated_lines.hpp).
#pragma once

#include "encoder/inputs/coded_lines.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline textures {

/// The lines of the image to code; none where all are. A PSNR counts all texels, so for a PSNR all
/// lines are coded if runs differ clearly in length, or beside an alpha, where nobody knows by how
/// much a run counts.
CodedLines texelLines(const EncodeInputs& inputs);

}  // namespace tetrakis::inline textures
