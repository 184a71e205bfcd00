// SPDX-License-Identifier: Apache-2.0
// WeightedSurface is a surface of which some samples may be unknown, so that fits leave them out.
#pragma once

#include <cstdint>
#include <span>

#include "codec/mesh/surface/surface_view.hpp"

namespace tetrakis::inline surface {

/// Where known[i] is 0, sample i does not count in fits, whatever its weight in the view. Where
/// `known` is empty, all samples are known.
struct WeightedSurface {
  SurfaceView view;
  std::span<const uint8_t> known = {};

  bool isWeighted() const { return !known.empty() || !view.weights.empty(); }
  bool isKnown(size_t sample) const { return known.empty() || known[sample] != 0; }
  double weightOf(uint32_t sample) const { return isKnown(sample) ? view.weightOf(sample) : 0; }
};

}  // namespace tetrakis::inline surface
