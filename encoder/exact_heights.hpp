// SPDX-License-Identifier: Apache-2.0
// Heights to the last bit can take fewer bytes than heights that are off by little: the last
// bit-planes of lossy coefficients are noise, and heights of few values lie in a table that lossy
// coding does not have. So a lossless coding is an attempt at other targets, too.
#pragma once

#include <memory>

#include "encoder/coded_heights.hpp"
#include "encoder/inputs.hpp"

namespace tetrakis::inline encoder {

/// The heights as the target `lossless` has them. error: what the target of inputs allows, in
/// sample units, as the largest or the mean one. Null where that is so much that it cannot pay,
/// unless the heights have a table of values.
std::shared_ptr<const CodedHeights> exactHeightsFor(const EncodeInputs& inputs, double error);

}  // namespace tetrakis::inline encoder
