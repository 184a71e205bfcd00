// SPDX-License-Identifier: Apache-2.0
// Reference decoder: heights before they become samples (docs/FORMAT.md, sections 7 and 8).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "conformance/reference_decoder/regions.hpp"
#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/track.hpp"
#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {

/// What is known of the heights before they become samples.
struct Surface {
  std::vector<std::vector<Part>> parts;  ///< by track
  std::vector<std::vector<Band>> bands;  ///< likewise
  int f = 0;
  Plane plane;
};

/// lifted: what section 7 takes for valid samples; empty: all.
Surface decodeSurface(const GeometryHeader& header, const std::vector<uint8_t>& lifted,
                      const std::vector<std::span<const uint8_t>>& coefficients, Plane known,
                      int level);

/// 1 where a sample has a significant coefficient.
Plane significanceOf(const Surface& surface);

}  // namespace tetrakis::reference
