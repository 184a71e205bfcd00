// SPDX-License-Identifier: Apache-2.0
// ChannelTables hold the values of channels whose type could hold many more: photographs that were
// stretched over their type, 11 bits in 16, 8 bits times 257. The wavelet then codes the places of
// samples in a sorted table, and between two places lies the interpolation of their values, so that
// cuts stay good though gaps are uneven. The tables stand in the header, so that every prefix has
// them. Only lossless streams have tables.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bitstream/stream/texture_header.hpp"

namespace tetrakis::inline tables {

/// A list for each channel, smallest value first; empty: its samples are no places.
using ChannelTables = std::array<std::vector<uint16_t>, 4>;

/// The tables that a header describes. Safe on any code. The values of damaged ones have any order.
ChannelTables channelTablesOf(const TextureHeader& header);

/// What channelTablesOf() takes beside the tables themselves, and these.
uint64_t tableBytesOf(const TextureHeader& header);

/// Makes samples of places, which lie `centre` above the channel and have fraction_bits binary
/// places. table: not empty.
void placesToSamples(std::span<const uint16_t> table, uint16_t centre, int fraction_bits,
                     std::span<int32_t> channel);

}  // namespace tetrakis::inline tables
