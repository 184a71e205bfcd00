// SPDX-License-Identifier: Apache-2.0
// Reference decoder: samples that go on from exact ones before them (docs/FORMAT.md, sections
// 8.1.11 and 8.1.12).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/wavelet.hpp"

namespace tetrakis::reference {

/// Both correct the samples as far as they are decided.
void correctFromRelative(const GeometryHeader& header, const Layers& layers,
                         std::span<const uint8_t> codeword, const Plane& plane,
                         std::vector<uint32_t>& samples);

/// plane: heights in whole steps.
void correctFromFacets(const GeometryHeader& header, const Layers& layers,
                       std::span<const uint8_t> codeword, const Plane& plane,
                       std::vector<uint32_t>& samples);

}  // namespace tetrakis::reference
