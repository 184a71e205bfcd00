// SPDX-License-Identifier: Apache-2.0
// explain() tells a caller of tks_encode() the plans that the encoder weighed.
#pragma once

#include "encoder/encode_stream.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline api {

/// Calls options.explain, which is not null, for each plan. scale: of the heights; 1 without them.
void explain(const PlanNotes& notes, double scale, const tks_encode_options& options);

}  // namespace tetrakis::inline api
