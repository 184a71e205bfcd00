// SPDX-License-Identifier: Apache-2.0
// This file finds out what the bytes of a coded component take off its errors. It tells rate
// control how to measure heights and textures.
#pragma once

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline targets {

ComponentCurve curveOfHeights(const EncodeInputs& inputs, const CodedHeights& heights);

ComponentCurve curveOfTexture(const EncodeInputs& inputs, const CodedTexture& texture);

}  // namespace tetrakis::inline targets
