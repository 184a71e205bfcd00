// SPDX-License-Identifier: Apache-2.0
#include "codec/lines/shown_lines.hpp"

#include <string>

#include "bitstream/coder/range_encoder.hpp"

namespace tetrakis::inline lines {

LineRepeats encodeRepeats(std::vector<uint8_t> columns, std::vector<uint8_t> rows) {
  const Extent shown{static_cast<uint32_t>(columns.size()), static_cast<uint32_t>(rows.size())};
  DecisionEncoding io;
  RepeatPass<DecisionEncoding> pass(io);
  pass.run(columns);
  pass.run(rows);
  const std::vector<uint8_t> code = io.finish();
  return {shown, std::string(code.begin(), code.end())};
}

}  // namespace tetrakis::inline lines
