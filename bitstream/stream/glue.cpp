// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/glue.hpp"

#include "bitstream/coder/range_decoder.hpp"
#include "bitstream/stream/glue_pass.hpp"

namespace tetrakis::inline stream {

std::optional<std::vector<uint32_t>> decodeGlue(std::string_view codeword, uint32_t patches) {
  DecisionDecoding io({reinterpret_cast<const uint8_t*>(codeword.data()), codeword.size()});
  std::vector<uint32_t> sides(size_t{patches} * Forest::kSides, Forest::kBorder);
  GluePass pass(io, patches, Forest::kSides);
  if (!pass.run(sides)) return {};
  return sides;
}

}  // namespace tetrakis::inline stream
