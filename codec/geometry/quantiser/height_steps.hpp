// SPDX-License-Identifier: Apache-2.0
// HeightSteps holds heights of any sample type as integer steps: sample = base + q * step. The
// functions compute the corrections that restore samples which their steps do not show.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/values/value_table.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline quantiser {

/// Returns the size of a height field of the C interface.
inline Extent extentOf(const tks_heights& heights) {
  return {heights.width, heights.height};
}

struct HeightSteps {
  std::vector<int32_t> steps;   ///< |q| <= 2^25, centred on 0; of voids any
  std::vector<uint8_t> valid;   ///< 1 valid, 0 void; empty: all are valid
  uint8_t bridge = 0;           ///< the reach of bridges over voids (codec/wavelet/bridges.hpp)
  std::vector<uint8_t> lifted;  ///< with bridges only: liftedSamples()
  double base = 0, step = 1;
  ValueTable table;    ///< not empty: steps count its values, which `base` and `step` approximate
  bool exact = false;  ///< every valid sample comes back bit for bit
  int range_bits = 0;  ///< the steps span less than 2^range_bits

  size_t validCount() const;
  size_t liftedCount() const;
  /// The share of the squared error of the lifted samples that falls, roughly, on the valid ones.
  double liftedShare() const;
  /// The steps as a plane for the transform.
  PlaneView<const int32_t> lifting(Extent plane) const {
    return {steps, plane, bridge == 0 ? valid : lifted};
  }
};

/// The whole steps of the heights as decoders have them, which turn places in a table into heights.
std::vector<int32_t> decodedSteps(const HeightSteps& steps, const GeometryHeader& header);

/// The corrections that restore the samples.
std::vector<int32_t> sampleCorrections(const tks_heights& heights, const HeightSteps& steps);

}  // namespace tetrakis::inline quantiser
