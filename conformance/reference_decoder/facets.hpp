// SPDX-License-Identifier: Apache-2.0
// Reference decoder: corrections from facets (docs/FORMAT.md, section 8.1).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {

/// Corrects the samples, as far as they are decided. plane: heights in whole steps.
void correctFromFacets(const GeometryHeader& header, const Layers& layers,
                       std::span<const uint8_t> codeword, const Plane& plane,
                       std::vector<uint32_t>& samples);

}  // namespace tetrakis::reference
