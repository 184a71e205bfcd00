// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/priority_map.hpp"

#include "bitstream/coder/range_encoder.hpp"

namespace tetrakis::inline wavelet {

PriorityHeader headerOf(const PriorityMap& map) {
  if (map.empty()) return {};
  DecisionEncoding io;
  std::vector<uint8_t> priorities = map.priorities;
  PriorityPass<DecisionEncoding>(io).run(map.columns(), priorities);
  const std::vector<uint8_t> code = io.finish();
  return {static_cast<uint8_t>(map.tile_log2), std::string(code.begin(), code.end())};
}

}  // namespace tetrakis::inline wavelet
