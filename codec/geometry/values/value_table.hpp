// SPDX-License-Identifier: Apache-2.0
// A ValueTable holds the values that the samples of a height field have, where their type could
// hold many more: feet written as metres, maps of 8 bits that were rescaled, decimal fractions that
// no float holds. The wavelet then codes the place of a sample's value in the sorted table, and the
// table turns places into samples.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/steps/value_in_steps.hpp"

namespace tetrakis::inline values {

/// The values of the samples as words (codec/geometry/steps/sample_order.hpp), the smallest first.
struct ValueTable {
  std::vector<uint32_t> words;

  bool empty() const { return words.empty(); }
  /// The place of step q, which counts from the middle of the table. Steps beyond the ends have the
  /// place of the end.
  size_t placeOf(int32_t q) const {
    const int64_t place = int64_t{q} + static_cast<int64_t>(words.size() / 2);
    return static_cast<size_t>(
        std::clamp<int64_t>(place, 0, static_cast<int64_t>(words.size()) - 1));
  }
  uint32_t wordOf(int32_t q) const { return words[placeOf(q)]; }
};

inline constexpr int kWordBits = 32;

/// Heights of a table lie between steps.
inline constexpr int kTableFractionBits = 4;

/// Each value of the table, which is not empty, in steps. header: sample type, base and step.
std::vector<ValueInSteps> valuesInSteps(const ValueTable& table, const GeometryHeader& header);

/// Turns places in the table into heights between steps, with a correction for each sample.
DecodedHeights heightsOf(const ValueTable& table, const GeometryHeader& header,
                         DecodedGeometry places);

}  // namespace tetrakis::inline values
