// SPDX-License-Identifier: Apache-2.0
// findRelativeStep() finds the relative step of samples that have one, and encodeRelative() codes
// the corrections that restore these samples behind decoded heights (relative_pass.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "base/plane.hpp"
#include "base/view.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline relative {

/// The codeword that leads from decoded heights to the samples of a part, whatever these are.
/// steps: the heights in whole steps, and which of them are valid. header: base and step. relative:
/// a finite and positive step, 1 to 4 quarters.
std::vector<uint8_t> encodeRelative(const tks_heights& samples, PlaneView<const int32_t> steps,
                                    const Window& part, const GeometryHeader& header,
                                    const RelativeSteps& relative);

// findRelativeStep() finds the relative step of floats (relative_pass.hpp) from the distances
// by which samples miss the prediction of their neighbours: jumps gather at multiples of the step.
// Ground of triangles is smooth between jumps of any size; there a small part of the jumps is the
// step.

/// The step whose multiples nearly all samples lie beside what their neighbours predict, and which
/// is much wider than the distance of neighbouring floats; 0 if there is none. On ground that is
/// smooth between edges it is a part of the jumps there, and may be of no use. Of large planes a
/// part is looked at.
double findRelativeStep(const tks_heights& heights, Mask valid);

}  // namespace tetrakis::inline relative
