// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/track.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

namespace tetrakis::inline track {

uint32_t BandPlan::members(size_t tier) const {
  uint32_t count = 0;
  if (tiers != nullptr) {
    const uint32_t* members = tiers->members.data() + tier * shape.wordCells();
    for (size_t i = 0; i < shape.wordCells(); ++i)
      count += static_cast<uint32_t>(std::popcount(members[i]));
    return count;
  }
  if (tier > 0) return 0;
  for (uint32_t word : absent) count += static_cast<uint32_t>(std::popcount(word));
  return shape.rows * shape.columns - count;
}

TrackState::TrackState(const std::vector<BandPlan>& plan, int planes) {
  uint32_t classes = 0;
  assert(planes >= 0 && planes <= 30);
  bands.reserve(plan.size());
  for (const BandPlan& band : plan) {
    Band& made = bands.emplace_back(band.shape, band.orientation, band.absent, band.tiers);
    for (TierState& tier : made.tier_states) tier.plane = planes;
    classes = std::max(classes, band.models + 1);
  }
  models.resize(classes);
}

}  // namespace tetrakis::inline track
