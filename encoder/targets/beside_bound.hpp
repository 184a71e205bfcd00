// SPDX-License-Identifier: Apache-2.0
// textureBesideBound() decides how many bytes a texture gets beside heights that keep a largest
// error. The caller gives no size for the texture, so it gets the packets that are worth as much as
// the bytes that bring the heights within their bound.
#pragma once

#include <cstdint>

#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/targets/candidates.hpp"

namespace tetrakis::inline targets {

/// The bytes of the texture's packets that are worth as much as the bytes that bring heights within
/// the largest error; all bytes if heights of one value take none. candidates: heights within that
/// error, and a texture with a curve.
uint64_t textureBesideBound(const EncodeInputs& inputs, const Candidates& candidates);

}  // namespace tetrakis::inline targets
