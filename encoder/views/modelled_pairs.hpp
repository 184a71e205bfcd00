// SPDX-License-Identifier: Apache-2.0
// modelledErrors() is the modelled engine: rays of the cameras (ratecontrol/pictures/) look at all
// pairs of a prefix of the heights with a prefix of the texture, and give the error of each
// picture.
#pragma once

#include <vector>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/views/decoded_nodes.hpp"
#include "encoder/views/nodes.hpp"

namespace tetrakis::inline views {

/// Errors of the pictures of all pairs, in the order that PairErrors takes; none if nobody can look
/// at the terrain.
std::vector<double> modelledErrors(const EncodeInputs& inputs, DecodedNodes& decoded,
                                   const Nodes& nodes);

}  // namespace tetrakis::inline views
