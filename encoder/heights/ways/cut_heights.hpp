// SPDX-License-Identifier: Apache-2.0
// Coefficients are cut, and corrections follow. What is said of them here holds for one track and
// for many.
#pragma once

#include <optional>

#include "encoder/heights/coded_heights.hpp"

namespace tetrakis::inline ways {

/// The heights cut where their squared error, in steps, falls to so much: what takes off most error
/// a byte is kept of all tracks. Nothing if they do not come so far. whole: without corrections.
std::optional<CodedHeights> cutAt(const CodedHeights& whole, double squares);

/// The heights with corrections behind their coefficients. layers: theirs, with what the header
/// says of corrections. corrected_to: the squared error, in steps, that these leave.
CodedHeights followedBy(CodedHeights heights, GeometryLayers layers,
                        const PartCodewords& corrections, double corrected_to);

}  // namespace tetrakis::inline ways
