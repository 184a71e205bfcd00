// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/values/value_table_decoder.hpp"

#include "bitstream/coder/decision_decoding.hpp"
#include "bitstream/coder/value_table_pass.hpp"

namespace tetrakis::inline values {

ValueTable decodeValueTable(std::span<const uint8_t> codeword, uint32_t values) {
  ValueTable table{std::vector<uint32_t>(values)};
  DecisionDecoding io(codeword);
  ValueTablePass<DecisionDecoding<>>(io, kWordBits).run(table.words);
  if (io.stopped()) return {};
  return table;
}

}  // namespace tetrakis::inline values
