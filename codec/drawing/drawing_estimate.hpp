// SPDX-License-Identifier: Apache-2.0
// estimateDrawing() foretells from the samples of a plane how many bytes a drawing of them takes,
// in a small part of the time of coding it.
#pragma once

#include "base/plane.hpp"

namespace tetrakis::inline drawing {

/// What a sample says that is like neither the one before nor the one above: by how much it differs
/// from the one before, or which value it has.
enum class Alone { kDifference, kValue };

/// About how many bytes the samples take as a drawing; the first column and row cost nothing.
/// Value: int32_t, or uint16_t.
template <class Value>
double estimateDrawing(const PlaneView<const Value>& samples, Alone alone);

}  // namespace tetrakis::inline drawing
