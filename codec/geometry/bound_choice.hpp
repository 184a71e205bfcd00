// SPDX-License-Identifier: Apache-2.0
// Which way of keeping heights within a largest error is worth trying, and where to cut.
#pragma once

#include <cstdint>
#include <optional>

#include "bitstream/stream/header.hpp"
#include "codec/geometry/height_steps.hpp"

namespace tetrakis {

struct BoundWays {
  bool round = true;    ///< to multiples of 2 * largest + 1 steps, coded to the last bit
  bool correct = true;  ///< coefficients that are cut, and corrections behind them
  /// Mean squared error, in steps, that the cut leaves; nothing: to be searched for.
  std::optional<double> mean_square = {};
};

/// largest: error allowed, in steps. Of planes of at most 1025 * 1025 samples both ways are to be
/// tried, which takes some twenty times as long as coding them. Of larger ones both are tried on
/// typical parts, and the way of fewer bytes there is taken for the whole. wavelet: of coefficients
/// that will be cut.
BoundWays boundWays(const HeightSteps& steps, uint32_t width, uint32_t height,
                    const WaveletHeader& wavelet, int32_t largest);

}  // namespace tetrakis
