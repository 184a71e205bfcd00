// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/line_repeats.hpp"

#include <cassert>

#include "bitstream/coder/range_decoder.hpp"

namespace tetrakis::inline stream {

LineMaps lineMapsOf(const LineRepeats& repeats) {
  assert(!repeats.none());
  const auto* bytes = reinterpret_cast<const uint8_t*>(repeats.code.data());
  DecisionDecoding io(std::span(bytes, repeats.code.size()));
  RepeatPass<DecisionDecoding<>> pass(io);
  const auto map = [&](uint32_t lines) {
    std::vector<uint8_t> repeated(lines);
    if (!io.stopped()) pass.run(repeated);
    std::vector<uint32_t> coded(lines);
    for (uint32_t i = 1; i < lines; ++i) coded[i] = coded[i - 1] + (repeated[i] == 0);
    return coded;
  };
  LineMaps maps;
  maps.columns = map(repeats.shown.width);
  maps.rows = map(repeats.shown.height);
  return maps;
}

}  // namespace tetrakis::inline stream
