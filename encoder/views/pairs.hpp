// SPDX-License-Identifier: Apache-2.0
// pairErrorsOf() measures the cost of errors of either component in the cameras' pictures: an
// engine, modelled or rendered, looks at pairs of prefixes of both (thesis 6.3.1). The errors of
// heights and texture do not add, so neither component can be measured alone.
#pragma once

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/views/decoded_nodes.hpp"
#include "ratecontrol/allocation/pair_errors.hpp"

namespace tetrakis::inline views {

/// Decodes some prefixes of either component and looks at their pairs. inputs: of both.
PairErrors pairErrorsOf(const EncodeInputs& inputs, const Rated<CodedHeights>& heights,
                        const Rated<CodedTexture>& texture);

}  // namespace tetrakis::inline views
