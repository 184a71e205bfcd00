// SPDX-License-Identifier: Apache-2.0
// heightsNeed() finds the number of bytes of coded heights that reaches the PSNR of the options.
#pragma once

#include <cstdint>
#include <optional>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/targets/candidates.hpp"

namespace tetrakis::inline targets {

/// The first bytes of the heights' packets that reach the PSNR; nothing where none do. The PSNR is
/// reached only when the place of the voids is known. heights: with a curve.
std::optional<uint64_t> heightsNeed(const EncodeInputs& inputs, const HeightsCandidate& heights);

}  // namespace tetrakis::inline targets
