// SPDX-License-Identifier: Apache-2.0
// Reference decoder: what corrections make of heights and of their samples (docs/FORMAT.md, section
// 8.1).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "conformance/reference_decoder/height_samples.hpp"
#include "conformance/reference_decoder/stream.hpp"
#include "conformance/reference_decoder/surface.hpp"

namespace tetrakis::reference {

/// Corrections of steps. codewords: that of the plane, or one for each of the finest regions.
void correctSteps(const GeometryHeader& header, const Layers& layers,
                  const std::vector<std::span<const uint8_t>>& codewords, Surface& surface);

/// Corrections of samples, which are made of the surface. codewords: likewise.
void correctSamples(const GeometryHeader& header, const Layers& layers,
                    const std::vector<std::span<const uint8_t>>& codewords, const Surface& surface,
                    MadeSamples& samples);

}  // namespace tetrakis::reference
