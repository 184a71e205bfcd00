// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/values/value_table.hpp"

#include "bitstream/coder/range_encoder.hpp"
#include "bitstream/coder/value_table_pass.hpp"

namespace tetrakis::inline values {

std::vector<uint8_t> encodeValueTable(const ValueTable& table) {
  DecisionEncoding io;
  std::vector<uint32_t> words = table.words;
  ValueTablePass<DecisionEncoding>(io, kValueBits).run(words);
  return io.finish();
}

}  // namespace tetrakis::inline values
