// SPDX-License-Identifier: Apache-2.0
// What cameras see of prefixes of a stream that is not written yet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/selection/selection.hpp"

namespace tetrakis::inline views {

/// Squared errors of the picture after so many bytes of the packets, their heads counted.
/// selection, inputs: of both components. lengths: rising. Empty: nobody can look at the terrain.
std::vector<double> errorsOfPrefixes(const EncodeInputs& inputs, const Selection& selection,
                                     std::span<const uint64_t> lengths);

}  // namespace tetrakis::inline views
