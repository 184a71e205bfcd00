// SPDX-License-Identifier: Apache-2.0
// Domains of awkward cases that are no planes: patches that are glued anyhow, and globes.
#pragma once

#include <cstdint>

#include "tests/awkward/awkward_case.hpp"
#include "tests/awkward/awkward_ground.hpp"

namespace tetrakis::test {

/// Puts other heights of this kind, and a texture if there is one, on patches that are glued in any
/// way: to each other, to themselves, or to nothing. Voids and options that forests lack go.
void putOnForest(Dice& dice, AwkwardCase& c, Kind kind, uint32_t most_samples);

/// The same on a cube, of a geographic grid.
void putOnCube(Dice& dice, AwkwardCase& c, Kind kind, uint32_t most_samples);

/// Makes the heights a cylinder, which may lie round the Earth.
void putOnCylinder(Dice& dice, AwkwardCase& c);

}  // namespace tetrakis::test
