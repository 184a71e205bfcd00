// SPDX-License-Identifier: Apache-2.0
// StandIn is the curve that stands for a table of values while bytes of the table are missing: a
// polyline through a few of its values (the knots, which the header holds) or, without knots, the
// straight line of base and step.
#pragma once

#include <cstdint>
#include <span>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"

namespace tetrakis::inline values {

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
