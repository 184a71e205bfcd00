// SPDX-License-Identifier: Apache-2.0
// boundWays() decides which of two ways to keep heights within a largest error is worth trying
// (rounding to coarser steps, or a cut with corrections), and where to cut, by typical parts.
#pragma once

#include <cstdint>
#include <optional>

#include "base/plane.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"

namespace tetrakis::inline coding_choice {

struct BoundWays {
  bool round = true;    ///< to multiples of 2 * largest + 1 steps, coded to the last bit
  bool correct = true;  ///< coefficients that are cut, and corrections behind them
  /// Mean squared error, in steps, that the cut leaves; nothing: to be searched for.
  std::optional<double> mean_square = {};
  /// Bytes of the plane by either way, as typical parts foretell them; nothing: nobody looked.
  std::optional<double> rounded_bytes = {}, corrected_bytes = {};
};

/// Says which ways to try. largest: the error allowed, in steps. wavelet: that of coefficients that
/// will be cut. Both ways are worth trying for planes of at most 1025 * 1025 samples, which takes
/// some twenty times as long as coding them. For larger planes both ways are tried on typical parts
/// here, and the way that takes fewer bytes there is the one to try for the whole plane.
BoundWays boundWays(const HeightSteps& steps, Extent plane, const WaveletHeader& wavelet,
                    int32_t largest);

}  // namespace tetrakis::inline coding_choice
