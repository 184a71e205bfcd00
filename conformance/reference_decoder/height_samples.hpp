// SPDX-License-Identifier: Apache-2.0
// Reference decoder: the samples that heights become (docs/FORMAT.md, sections 8 to 8.2).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "conformance/reference_decoder/surface.hpp"

namespace tetrakis::reference {

/// The bits of the samples that heights become.
struct MadeSamples {
  std::vector<uint32_t> bits;
  std::vector<uint32_t> near;  ///< those that hints of corrections come from
};

/// FORMAT 8, "Samples", or with a table of values 8.1, "Table of values".
MadeSamples samplesOf(const GeometryHeader& header, const std::vector<uint32_t>& table,
                      const Surface& surface);

/// FORMAT 8.1, "Stand-in": heights between steps in the place of a table.
void standIn(const Layers& layers, Surface& surface);

/// FORMAT 8.1, "Voids": voids get their value, and no other sample has it.
void putVoids(const GeometryHeader& header, const Layers& layers, const Plane& plane,
              std::vector<uint32_t>& samples);

/// Little endian.
std::vector<uint8_t> bytesOf(const GeometryHeader& header, const std::vector<uint32_t>& samples);

/// FORMAT 8.2.
std::vector<uint8_t> decodeStored(const GeometryHeader& header, const Layers& layers,
                                  std::span<const uint8_t> bytes, const std::vector<uint8_t>& valid,
                                  int level);

}  // namespace tetrakis::reference
