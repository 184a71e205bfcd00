// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/bridges.hpp"

#include <utility>

#include "codec/wavelet/morphology.hpp"

namespace tetrakis::inline wavelet {

SharedBits liftedSamples(const SharedBits& valid, uint8_t reach) {
  if (reach == 0 || valid == nullptr) return valid;
  if (reach == kBridgeAll) return nullptr;
  BitPlane lifted = closed(*valid, reach);
  return lifted.all() ? nullptr : shared(std::move(lifted));
}

std::vector<uint8_t> liftedSamples(const std::vector<uint8_t>& valid, Extent plane, uint8_t reach) {
  if (reach == 0) return valid;
  return shownMarks(liftedSamples(sharedBits(valid, plane), reach), {});
}

}  // namespace tetrakis::inline wavelet
