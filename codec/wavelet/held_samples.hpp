// SPDX-License-Identifier: Apache-2.0
// HeldSamples lists the samples that have their values before any coefficient is decoded: areas of
// constant height.
#pragma once

#include <cstdint>
#include <span>

namespace tetrakis::inline wavelet {

/// Area a holds the samples of number a + 1, and all of them have values[a]. The numbers and the
/// values belong to somebody else, who keeps them alive.
struct HeldSamples {
  std::span<const uint16_t>
      numbers;                      ///< one a sample, row by row: 0 for free ones; empty: all free
  std::span<const int32_t> values;  ///< one an area

  bool none() const { return numbers.empty(); }
};

}  // namespace tetrakis::inline wavelet
