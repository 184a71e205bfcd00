// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/tables/channel_tables_encoder.hpp"

#include "bitstream/coder/decision_encoding.hpp"
#include "bitstream/coder/value_table_pass.hpp"

namespace tetrakis::inline tables {

ChannelTablesHeader headerOf(const ChannelTables& tables, int sample_bits) {
  ChannelTablesHeader header;
  header.present = true;
  DecisionEncoding io;
  ValueTablePass<DecisionEncoding> pass(io, sample_bits);
  for (size_t c = 0; c < tables.size(); ++c) {
    header.values[c] = static_cast<uint32_t>(tables[c].size());
    std::vector<uint32_t> words(tables[c].begin(), tables[c].end());
    pass.run(words);
  }
  const std::vector<uint8_t> code = io.finish();
  header.code.assign(code.begin(), code.end());
  return header;
}

}  // namespace tetrakis::inline tables
