// SPDX-License-Identifier: Apache-2.0
// chooseStandIn() chooses the knots of the polyline that stands for a table of values while bytes
// of the table are missing, and computes the error that the polyline leaves.
#pragma once

#include <vector>

#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"

namespace tetrakis::inline quantiser {

struct StandInChoice {
  std::vector<TableKnot> knots;
  double squares = 0;  ///< squared error of the samples with complete coefficients, in steps
};

/// steps: with a table. table_bytes: of its codeword. most: the squared error that one sample adds
/// at most.
StandInChoice chooseStandIn(const HeightSteps& steps, const GeometryHeader& header,
                            size_t table_bytes, double most);

}  // namespace tetrakis::inline quantiser
