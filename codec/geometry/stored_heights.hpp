// SPDX-License-Identifier: Apache-2.0
// Heights that are stored sample by sample, because coding them would take more bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/header.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/geometry/height_layers.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis {

/// bytes: any prefix of what is stored of a geometry with header.stored(); valid: of the whole
/// plane, or empty. level: every 2^level-th sample. Steps are the nearest to the samples, and
/// corrections restore these. Samples of which nothing is there are those of step 0.
DecodedHeights decodeStored(const GeometryHeader& header, std::span<const uint8_t> bytes,
                            std::span<const uint8_t> valid, int level);

/// Bytes that storing the valid samples takes.
uint64_t storedBytes(const tks_heights& heights, size_t valid_samples);

/// Their codeword. valid: as in HeightSteps.
std::vector<uint8_t> storeSamples(const tks_heights& heights, std::span<const uint8_t> valid);

}  // namespace tetrakis
