// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/tables/channel_tables.hpp"

#include <algorithm>
#include <cassert>

#include "bitstream/coder/range_decoder.hpp"
#include "bitstream/coder/value_table_pass.hpp"

namespace tetrakis::inline tables {

ChannelTables channelTablesOf(const TextureHeader& header) {
  ChannelTables tables;
  if (!header.tables.present) return tables;
  const auto* bytes = reinterpret_cast<const uint8_t*>(header.tables.code.data());
  DecisionDecoding io(std::span(bytes, header.tables.code.size()));
  ValueTablePass<DecisionDecoding<>> pass(io, header.sampleBits());
  for (uint32_t c = 0; c < header.colourPlanes(); ++c) {
    std::vector<uint32_t> words(header.tables.values[c]);
    pass.run(words);
    if (io.stopped()) return tables;
    tables[c].resize(words.size());
    const uint32_t most = (1u << header.sampleBits()) - 1;
    std::transform(words.begin(), words.end(), tables[c].begin(),
                   [=](uint32_t word) { return static_cast<uint16_t>(word & most); });
  }
  return tables;
}

uint64_t tableBytesOf(const TextureHeader& header) {
  uint64_t all = 0, largest = 0;
  for (const uint64_t values : header.tables.values) {
    all += values;
    largest = std::max(largest, values);
  }
  return all * sizeof(uint16_t) + largest * sizeof(uint32_t);
}

void placesToSamples(std::span<const uint16_t> table, uint16_t centre, int fraction_bits,
                     std::span<int32_t> channel) {
  assert(!table.empty() && fraction_bits >= 0 && fraction_bits <= 8);
  const int64_t middle = int64_t{centre} << fraction_bits;
  const int64_t last = static_cast<int64_t>(table.size() - 1) << fraction_bits;
  const int32_t one = 1 << fraction_bits;
  for (int32_t& sample : channel) {
    const auto place = static_cast<int32_t>(std::clamp<int64_t>(sample + middle, 0, last));
    const auto below = static_cast<size_t>(place >> fraction_bits);
    const int32_t value = table[below], part = place & (one - 1);
    sample = part == 0 ? value
                       : value + (((table[below + 1] - value) * part + one / 2) >> fraction_bits);
  }
}

}  // namespace tetrakis::inline tables
