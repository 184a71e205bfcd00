// SPDX-License-Identifier: Apache-2.0
// inSteps() expresses a sample that is known without steps (neighbours restore it, or it stands in
// a table of values) as a height between steps and a correction that leads from there to the very
// sample, because everything behind the decoder of heights works on steps.
#pragma once

#include <cstdint>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"
#include "codec/geometry/steps/step_units.hpp"

namespace tetrakis::inline steps {

struct ValueInSteps {
  int32_t height;      ///< the nearest multiple of 2^-fraction_bits steps, up to 2^29
  int32_t correction;  ///< to the value, from the sample that the nearest whole step restores
};

/// grid: of the header's base and step.
template <class T>
ValueInSteps inSteps(T value, const GeometryHeader& header, const StepGrid& grid,
                     int fraction_bits) {
  ValueInSteps out{isNaN(value) ? 0 : grid.nearest(value, fraction_bits), 0};
  const T near = restore<T>(header.base, header.step, wholeStep(out.height, fraction_bits));
  out.correction = static_cast<int32_t>(orderOf(value) - orderOf(near));
  return out;
}

}  // namespace tetrakis::inline steps
