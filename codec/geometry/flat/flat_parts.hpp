// SPDX-License-Identifier: Apache-2.0
// The functions here choose parts of a plane in which flat areas and other heights meet. The
// encoder decides on these parts which flat areas save bytes, as they stand for the rest of the
// plane.
#pragma once

#include <cstdint>
#include <vector>

#include "base/view.hpp"
#include "codec/geometry/flat/flat_encoder.hpp"

namespace tetrakis::inline flat {

struct SampledPart {
  Window window;
  double stands_for;  ///< how many times its own samples
};

/// Returns one part, the whole plane, if that is small; else parts of each of three kinds: those
/// with samples of areas of at least `large` samples and others, those of the rest with samples of
/// areas of at least `small`, and those without. They are taken at equal distances along the rows
/// of parts of their kind.
std::vector<SampledPart> sampleParts(const FlatFinder& finder, uint32_t large, uint32_t small);

}  // namespace tetrakis::inline flat
