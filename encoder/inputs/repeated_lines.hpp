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

/// Samples of so many bytes each, row by row; of an image these are texels.
struct SampleGrid {
  const void* data;
  Extent extent;
  size_t sample_bytes;
};

/// The lines to code; none where all are. Lines are taken to repeat others where runs of them are
/// about as long everywhere, so that all coded samples count alike: a sea in the first hundred rows
/// is no reason to code one of them. least: how many columns, and how many rows, are coded at least
/// where there are as many.
CodedLines findRepeatedLines(const SampleGrid& grid, uint32_t least);

/// The same for an encoding. All lines are coded for a judge of pictures, who takes whole inputs,
/// and for budgets so small that the map of lines takes too much of them.
CodedLines linesThatPay(const tks_encode_options& options, const SampleGrid& grid, uint32_t least);

}  // namespace tetrakis::inline inputs
