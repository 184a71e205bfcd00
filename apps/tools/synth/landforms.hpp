// SPDX-License-Identifier: Apache-2.0
// The functions here are kinds of terrain whose ground differs from that of the mountains: in seas,
// lakes, plains and houses.
#pragma once

#include "apps/tools/synth/kind_task.hpp"

namespace tetrakis::tools::synth {

/// The sea rises until it covers half: valleys become bays, hills islands.
Storage drown(const KindTask& task);

/// Hollows as ice leaves them, each full of water.
Storage fillHollows(const KindTask& task);

/// Some metres of relief in all, under the noise of a scanner.
Storage flatten(const KindTask& task);

/// What a laser sees first, a metre apart: roofs, flat above the highest ground below them.
Storage build(const KindTask& task);

}  // namespace tetrakis::tools::synth
