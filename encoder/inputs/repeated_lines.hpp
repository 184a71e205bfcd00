// SPDX-License-Identifier: Apache-2.0
// findRepeatedLines() finds the columns and rows of heights, or of an image, that repeat the one
// before them. They are left out before anything else looks at the samples, so that every target
// profits from the smaller grid; decoders copy them at the end.
#pragma once

#include <cstddef>

#include "base/plane.hpp"
#include "encoder/inputs/coded_lines.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline inputs {

/// Samples of `sample_bytes` bytes each, row by row; of an image these are texels.
struct SampleGrid {
  const void* data;
  Extent extent;
  size_t sample_bytes;
};

/// The lines to code; none where all are. Lines count as repeated where runs of them are about as
/// long everywhere, so that all coded samples count alike: a sea in the first hundred rows is no
/// reason to code only one of these rows. least: how many columns, and how many rows, are coded at
/// least where there are as many.
CodedLines findRepeatedLines(const SampleGrid& grid, uint32_t least);

/// The lines to code in an encoding. All lines are coded for a judge of pictures, who takes whole
/// inputs, and for budgets of which the map of lines would take too much.
CodedLines linesThatPay(const tks_encode_options& options, const SampleGrid& grid, uint32_t least);

}  // namespace tetrakis::inline inputs
