// SPDX-License-Identifier: Apache-2.0
// fewValuesOf() finds the channels of an image that use few values of their type, and makes the
// tables of these values (channel_tables.hpp) whose places are coded instead; headerOf() codes the
// tables. Encoder only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/samples.hpp"
#include "bitstream/stream/texture_header.hpp"
#include "texture_wavelet/tables/channel_tables.hpp"

namespace tetrakis::inline tables {

// fewValuesOf() finds the channels of an image that use few of the values of their type, and makes
// tables of these values.

struct FewValues {
  ChannelTables tables;  ///< of the channels for which they save bits
  /// For each channel, the squared error of samples per squared error of places: by the geometric
  /// mean of the gaps between its values.
  std::array<double, 4> squares = {1, 1, 1, 1};

  bool none() const;
};

/// The tables of the first channels of an image, if they may save more than a 32nd of a bit a
/// sample. coded: the texels whose samples they hold.
FewValues fewValuesOf(const Texels& texels, uint32_t channels, Mask coded);

/// Turns the samples of a channel into places; those that are not coded into 0 where their value is
/// in no table.
void samplesToPlaces(const std::vector<uint16_t>& table, std::vector<int32_t>& channel);

// headerOf() codes the tables of channels as the part of the header that holds them.

/// sample_bits: of the values.
ChannelTablesHeader headerOf(const ChannelTables& tables, int sample_bits);

}  // namespace tetrakis::inline tables
