// SPDX-License-Identifier: Apache-2.0
// curveOfHeights() and curveOfTexture() find out how far the bytes of a coded component lower its
// errors. They tell ratecontrol/curves/, which knows no samples, how to decode and measure a
// prefix.
#pragma once

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "ratecontrol/curves/component_curve.hpp"

namespace tetrakis::inline targets {

ComponentCurve curveOfHeights(const EncodeInputs& inputs, const CodedHeights& heights);

ComponentCurve curveOfTexture(const EncodeInputs& inputs, const CodedTexture& texture);

}  // namespace tetrakis::inline targets
