// SPDX-License-Identifier: Apache-2.0
// objectErrors() is the modelled engine for surfaces over a base mesh: it draws pairs of a prefix
// of the heights with a prefix of the texture for cameras all around, or for those of the options.
#pragma once

#include <vector>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/views/decoded_nodes.hpp"

namespace tetrakis::inline views {

/// Errors of the pictures of all pairs, in the order that PairErrors takes; none if nobody can look
/// at the surface. inputs: of both components on a forest.
std::vector<double> objectErrors(const EncodeInputs& inputs, DecodedNodes& decoded,
                                 const Nodes& nodes);

}  // namespace tetrakis::inline views
