// SPDX-License-Identifier: Apache-2.0
// CodedLines is the part of heights, or of an image, that is coded where columns and rows repeat
// the one before them: the other lines, and the map of repeats (bitstream/stream/line_repeats.hpp).
// Rasters that were enlarged by copying samples, or warped to the nearest one, have such lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitstream/stream/line_repeats.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline inputs {

/// Heights, or an image, without the lines that repeat others.
struct CodedLines {
  LineRepeats repeats;             ///< none: it does not pay
  std::vector<std::byte> samples;  ///< of the lines that are coded
  Extent extent = {0, 0};          ///< of these
  /// A coded sample counts as often as it is shown. This is the weight of the sample that is shown
  /// most often, divided by the mean weight: the mean squared error of all samples is at most as
  /// many times that of the coded ones.
  double heaviest = 1;
  /// `heaviest` up to which a PSNR is met on coded samples. A larger number drops lines of more
  /// files, and asks coded samples for an error that much smaller.
  static constexpr double kNearlyAlike = 1.1;
  std::vector<uint32_t> shown_by;  ///< how many samples each coded one stands for

  /// The coded part of `whole`. Its data is `samples`, which outlives the result.
  tks_heights of(const tks_heights& whole) const;
  tks_image of(const tks_image& whole) const;
};

}  // namespace tetrakis::inline inputs
