// SPDX-License-Identifier: Apache-2.0
// exactHeightsFor() codes heights to the last bit for a target that does not ask for the last bit,
// where exact heights may take fewer bytes than inexact ones: the last bit-planes of lossy
// coefficients are noise, and lossy coding knows nothing of tables of values and drawings, which
// suit heights of few values.
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
