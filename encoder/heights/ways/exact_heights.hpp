// SPDX-License-Identifier: Apache-2.0
// Heights to the last bit can take fewer bytes than heights that are off by little: the last
// bit-planes of lossy coefficients are noise, and heights of few values lie in a table, or are
// drawn, which lossy coding knows nothing of. So a lossless coding is an attempt at other targets,
// too.
#pragma once

#include <cstdint>
#include <memory>

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline ways {

/// Whether exact steps may take no more bytes than so many to the last bit, by typical parts.
bool mayTakeNoMore(const HeightSteps& steps, Extent extent, uint64_t bytes);

/// The heights as the target `lossless` has them. error: what the target of inputs allows, in
/// sample units, as the largest or the mean one; lossy_bytes: what heights take that use it. Null
/// where the error is so much that exact ones cannot pay, unless they have few values: a table of
/// them, or a drawing that may fit.
std::shared_ptr<const CodedHeights> exactHeightsFor(const EncodeInputs& inputs, double error,
                                                    uint64_t lossy_bytes);

}  // namespace tetrakis::inline ways
