// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/values/value_table_encoder.hpp"

#include "bitstream/coder/decision_encoding.hpp"
#include "bitstream/coder/value_table_pass.hpp"

namespace tetrakis::inline values {

std::vector<uint8_t> encodeValueTable(const ValueTable& table) {
  DecisionEncoding io;
  std::vector<uint32_t> words = table.words;
  ValueTablePass<DecisionEncoding>(io, kWordBits).run(words);
  return io.finish();
}

}  // namespace tetrakis::inline values
