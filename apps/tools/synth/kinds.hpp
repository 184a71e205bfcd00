// SPDX-License-Identifier: Apache-2.0
// reshape() changes the mountains into another kind of terrain. Each kind is a small change that
// brings out one trait of real terrain models.
#pragma once

#include "apps/tools/synth/kind_task.hpp"
#include "apps/tools/synth/synth.hpp"

namespace tetrakis::tools::synth {

/// Turns the mountains of `size` into another kind, and says how to store it.
Storage reshape(Relief& relief, SynthKind kind, uint32_t size, uint64_t seed);

}  // namespace tetrakis::tools::synth
