// SPDX-License-Identifier: Apache-2.0
#include "wavelet/bridges.hpp"

#include <algorithm>

#include "wavelet/morphology.hpp"

namespace tetrakis::inline wavelet {

std::vector<uint8_t> liftedSamples(const std::vector<uint8_t>& valid, Extent plane, uint8_t reach) {
  if (reach == 0 || valid.empty()) return valid;
  if (reach == kBridgeAll) return {};
  std::vector<uint8_t> lifted = closed(valid, plane, reach);
  const bool all = std::all_of(lifted.begin(), lifted.end(), [](uint8_t mark) { return mark; });
  return all ? std::vector<uint8_t>() : lifted;
}

}  // namespace tetrakis::inline wavelet
