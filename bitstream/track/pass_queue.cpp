// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/pass_queue.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

namespace tetrakis::inline track {

namespace {

/// Delays against the plain order by norm * 2^plane, in 1/16 of a bit-plane, by the density of
/// significant coefficients in the band: [d] for 2^-d to 2^(1-d). The fewer are significant, the
/// less do the others buy. Fitted to the PSNR that cut streams of images and terrain decode to;
/// the order of passes by the slopes dD/dR that they turn out to have would save another 0.5 %.
constexpr size_t kDensities = 16;
using Delays = std::array<uint8_t, kDensities>;
constexpr Delays kLikelyDelay = {0, 0, 1, 2, 2, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4};
constexpr Delays kRestDelay = {6, 6, 6, 7, 8, 8, 9, 10, 10, 11, 12, 14, 14, 15, 16, 16};
constexpr int kRefineDelay = 12;

int delayOf(PassKind kind, size_t density) {
  assert(density < kDensities);
  if (kind == PassKind::kRefine) return kRefineDelay;
  return (kind == PassKind::kLikely ? kLikelyDelay : kRestDelay)[density];
}

/// Greater keys first; of equal ones the higher plane, then the lower band, then the higher tier,
/// then the lower kind.
bool isLater(const Pass& a, const Pass& b) {
  if (a.key != b.key) return a.key < b.key;
  if (a.plane != b.plane) return a.plane < b.plane;
  if (a.band != b.band) return a.band > b.band;
  if (a.tier != b.tier) return a.tier < b.tier;
  return a.kind > b.kind;
}

}  // namespace

PassQueue::PassQueue(const std::vector<BandPlan>& plan, int planes)
    : progress_(kPriorities * plan.size()) {
  assert(planes >= 0 && plan.size() <= UINT16_MAX);
  if (planes == 0) return;
  for (size_t band = 0; band < plan.size(); ++band) {
    for (uint8_t tier = 0; tier < kPriorities; ++tier) {
      const uint32_t members = plan[band].members(tier);
      if (members == 0) continue;
      const Pass first = {static_cast<uint16_t>(band), tier, static_cast<uint8_t>(planes - 1),
                          PassKind::kLikely};
      progressOf(first) = {plan[band].log_norm + 16 * tier, plan[band].key_floor + 16 * tier,
                           plan[band].needed, members, 0};
      needed_ += plan[band].needed;
      push(first, 0);
    }
  }
}

void PassQueue::push(Pass pass, uint32_t significant) {
  assert(pass.plane < 30);
  Progress& progress = progressOf(pass);
  assert(significant <= progress.coefficients);
  const uint32_t rarity = progress.coefficients / std::max(significant, 1u);
  const auto density = std::min(static_cast<size_t>(std::bit_width(rarity)), kDensities - 1);
  pass.key = std::max(16 * pass.plane + progress.log_norm - delayOf(pass.kind, density),
                      progress.key_floor);
  ++progress.open;
  pending_.push_back(pass);
  std::push_heap(pending_.begin(), pending_.end(), isLater);
}

void PassQueue::pop(const Band& band) {
  assert(!pending_.empty() && progressOf(pending_.front()).open > 0);
  std::pop_heap(pending_.begin(), pending_.end(), isLater);
  const Pass done = pending_.back();
  pending_.pop_back();
  Progress& progress = progressOf(done);
  if (--progress.open > 0) return;
  const uint32_t significant = band.tier_states[done.tier].significant_count;
  Pass next = done;
  if (done.kind == PassKind::kLikely) {
    next.kind = PassKind::kRest;
    push(next, significant);
    next.kind = PassKind::kRefine;
    push(next, significant);
  } else if (done.plane > 0) {
    next.kind = PassKind::kLikely;
    --next.plane;
    push(next, significant);
  } else {
    assert(needed_ >= progress.needed);
    needed_ -= progress.needed;
  }
}

}  // namespace tetrakis::inline track
