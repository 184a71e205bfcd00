// SPDX-License-Identifier: Apache-2.0
// ValueTable holds the values of heights that have few of them, so that steps are places in the
// table. decodeValueTable() and encodeValueTable() take the table from its codeword and back, and
// StandIn replaces it while bytes of it are missing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/steps/restore.hpp"

namespace tetrakis::inline values {

// A ValueTable holds the values that the samples of a height field have, where their type could
// hold many more: feet written as metres, maps of 8 bits that were rescaled, decimal fractions that
// no float holds. The wavelet then codes the place of a sample's value in the sorted table, and the
// table turns places into samples.

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

inline constexpr int kValueBits = 32;

/// Heights of a table lie between steps.
inline constexpr int kTableFractionBits = 4;

/// Each value of the table, which is not empty, in steps. header: sample type, base and step.
std::vector<ValueInSteps> valuesInSteps(const ValueTable& table, const GeometryHeader& header);

/// Turns places in the table into heights between steps, with a correction for each sample.
DecodedHeights heightsOf(const ValueTable& table, const GeometryHeader& header,
                         DecodedGeometry places);

// decodeValueTable() decodes a table of values from its codeword.

/// codeword: any prefix of the codeword of a table. Empty unless all values are known. values: how
/// many there are. Safe on any bytes; takes memory for that many words and no more.
ValueTable decodeValueTable(std::span<const uint8_t> codeword, uint32_t values);

// encodeValueTable() codes a table of values as a codeword.

std::vector<uint8_t> encodeValueTable(const ValueTable& table);

// StandIn is the curve that stands for a table of values while bytes of the table are missing: a
// polyline through a few of its values (the knots, which the header holds) or, without knots, the
// straight line of base and step.

class StandIn {
 public:
  static constexpr int kFractionBits = 4;

  /// knots: by rising places, at least one. values: of the table.
  StandIn(std::span<const TableKnot> knots, uint32_t values) : knots_(knots), middle_(values / 2) {}

  /// The height, in 1/16 steps, of place v + middle of the table. v: in units of 2^-fraction_bits.
  int32_t heightOf(int32_t v, int fraction_bits) const;

 private:
  int64_t riseAt(int64_t place, int fraction_bits) const;

  std::span<const TableKnot> knots_;
  int64_t middle_;
};

/// Turns places in the table into heights between steps.
DecodedGeometry heightsOfStandIn(const GeometryLayers& layers, DecodedGeometry places);

}  // namespace tetrakis::inline values
