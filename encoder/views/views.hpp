// SPDX-License-Identifier: Apache-2.0
// What viewers see of the inputs: the cameras of the options, or those of a viewer of whom nothing
// is known, and the error of their pictures for prefixes of both components.
#pragma once

#include <span>
#include <vector>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/selection/selection.hpp"
#include "encoder/views/decoded_nodes.hpp"
#include "ratecontrol/allocation/pair_errors.hpp"

namespace tetrakis::inline views {

/// Decodes some prefixes of either component and looks at their pairs. inputs: of both.
PairErrors pairErrorsOf(const EncodeInputs& inputs, const Rated<CodedHeights>& heights,
                        const Rated<CodedTexture>& texture);

/// Squared errors of the picture after so many bytes of the packets, their heads counted.
/// selection, inputs: of both components. lengths: rising. Empty: nobody can look at the terrain.
std::vector<double> errorsOfPrefixes(const EncodeInputs& inputs, const Selection& selection,
                                     std::span<const uint64_t> lengths);

}  // namespace tetrakis::inline views
