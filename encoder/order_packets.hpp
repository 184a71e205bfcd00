// SPDX-License-Identifier: Apache-2.0
// This file finds out what every byte of a coded component is worth to a viewer. It tells rate
// control how to measure heights and textures, and how to price their errors in one unit.
#pragma once

#include "encoder/coded_heights.hpp"
#include "encoder/coded_texture.hpp"
#include "encoder/inputs.hpp"
#include "ratecontrol/component_curve.hpp"

namespace tetrakis::inline encoder {

/// texture: the image of the inputs, which heights are seen with; null: there is none.
ComponentCurve curveOfHeights(const EncodeInputs& inputs, const CodedHeights& heights,
                              const Texels* texture);

ComponentCurve curveOfTexture(const EncodeInputs& inputs, const CodedTexture& texture);

}  // namespace tetrakis::inline encoder
