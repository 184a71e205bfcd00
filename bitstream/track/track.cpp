// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/track.hpp"

#include <algorithm>
#include <cassert>

namespace tetrakis::inline track {

bool BandPlan::vacant() const {
  if (shape.empty() || absent.empty()) return shape.empty();
  for (uint32_t row = 0; row < shape.rows; ++row) {
    for (uint32_t x = 0; x < shape.words(); ++x) {
      if ((shape.valid(x) & ~absent[shape.word(row, x)]) != 0) return false;
    }
  }
  return true;
}

TrackState::TrackState(const std::vector<BandPlan>& plan, int planes) {
  uint32_t classes = 0;
  assert(planes >= 0 && planes <= 30);
  bands.reserve(plan.size());
  for (const BandPlan& band : plan) {
    bands.emplace_back(band.shape, band.orientation, band.absent).plane = planes;
    classes = std::max(classes, band.models + 1);
  }
  models.resize(classes);
}

}  // namespace tetrakis::inline track
