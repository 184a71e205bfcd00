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

/// Whether exact heights may take at most `bytes` bytes to the last bit, by typical parts; if not,
/// what these foretell is noted.
bool mayTakeNoMore(const EncodeInputs& inputs, const QuantisedHeights& heights, uint64_t bytes);

/// The heights that the target `lossless` would give. error: the largest or mean error, in sample
/// units, that the target of the inputs allows; lossy_bytes: bytes of lossy heights of this error.
/// Null where the error is so large that exact heights cannot pay, unless they have few values: a
/// table, or a drawing that may fit.
std::shared_ptr<const CodedHeights> exactHeightsFor(const EncodeInputs& inputs, double error,
                                                    uint64_t lossy_bytes);

}  // namespace tetrakis::inline ways
