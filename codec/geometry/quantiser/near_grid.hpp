// SPDX-License-Identifier: Apache-2.0
// nearGrid() finds the common unit near whose multiples floats lie, though not on them: whole
// metres that a program has shifted by a rounding of its own, feet that were written with three
// decimals. Within a largest error the multiples will do. Encoder only.
#pragma once

#include <optional>

#include "base/plane.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline quantiser {

/// The widest common unit, beyond 2 * error, that has a multiple within the error of every valid
/// sample. heights: of floats.
std::optional<double> nearGrid(const tks_heights& heights, Mask valid, double error);

}  // namespace tetrakis::inline quantiser
