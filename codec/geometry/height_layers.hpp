// SPDX-License-Identifier: Apache-2.0
// A geometry track taken apart: validity, table of values, coefficients, corrections
// (bitstream/stream/header.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "codec/geometry/corrections_pass.hpp"
#include "codec/geometry/geometry_decoder.hpp"

namespace tetrakis {

struct DecodedHeights {
  DecodedGeometry geometry;          ///< corrections of steps applied
  std::vector<int32_t> corrections;  ///< of the samples; empty where there are none
};

/// What one call of decodeLayers() leaves to the next, whose only track is longer by some bytes and
/// starts in the same memory. Empty at first.
struct HeightsMemory {
  std::vector<uint8_t> valid;  ///< once it is whole
  TrackMemory track;
};

/// The validity of a level's samples alone; empty: all are valid.
std::vector<uint8_t> decodeValidityLayer(const Codewords& codewords, const GeometryHeader& header,
                                         const GeometryLayers& layers, int level);

/// codewords: any prefix of each track; the layers are those of the first. Safe on any bytes.
/// level: as decodeGeometry takes it; above 0 without corrections, which are those of the samples.
DecodedHeights decodeLayers(const Codewords& codewords, const GeometryHeader& header,
                            const GeometryLayers& layers, int level = 0, uint32_t threads = 1,
                            HeightsMemory* memory = nullptr);

/// The same in a window, in time that follows its size where there are regions and no corrections.
DecodedHeights decodeLayersWindow(const Codewords& codewords, const GeometryHeader& header,
                                  const GeometryLayers& layers, const Window& window,
                                  uint32_t threads = 1);

/// The hints (codec/geometry/corrections_pass.hpp) of corrections of steps: how many of a vertex
/// and its four neighbours are significant.
std::vector<uint8_t> activityHints(const DecodedGeometry& geometry, uint32_t width,
                                   uint32_t height);

}  // namespace tetrakis
