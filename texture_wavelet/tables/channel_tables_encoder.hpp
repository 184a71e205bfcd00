// SPDX-License-Identifier: Apache-2.0
// headerOf() codes the tables of channels as the part of the header that holds them.
#pragma once

#include "bitstream/stream/texture_header.hpp"
#include "texture_wavelet/tables/channel_tables.hpp"

namespace tetrakis::inline tables {

/// sample_bits: of the values.
ChannelTablesHeader headerOf(const ChannelTables& tables, int sample_bits);

}  // namespace tetrakis::inline tables
