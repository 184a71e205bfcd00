// SPDX-License-Identifier: Apache-2.0
// renderedErrors() is the rendered engine: a renderer of the caller's (tks_picture_error) draws
// every other prefix of either component, and its errors correct those of the modelled engine for
// all pairs (ratecontrol/allocation/corrected_errors.hpp).
#pragma once

#include <vector>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/views/decoded_nodes.hpp"
#include "encoder/views/nodes.hpp"

namespace tetrakis::inline views {

/// Errors of the pictures of all pairs, in the order that PairErrors takes; none if the renderer
/// failed. inputs: with a renderer.
std::vector<double> renderedErrors(const EncodeInputs& inputs, DecodedNodes& decoded,
                                   const Nodes& nodes);

}  // namespace tetrakis::inline views
