// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/track.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

namespace tetrakis::inline track {

namespace {

/// How many regions stand along a side of a plane.
uint32_t regionsAlong(uint32_t side, int log2) {
  const uint64_t half = uint64_t{1} << (log2 - 1);
  return static_cast<uint32_t>(std::max<uint64_t>(1, (side + half) >> log2));
}

/// The longest side of a region: the first one's, or the last one's with the remainder.
uint32_t longestSide(uint32_t side, uint32_t regions, int log2) {
  if (regions == 1) return side;
  const uint64_t before = uint64_t{regions - 1} << log2;
  return std::max(uint32_t{1} << log2, static_cast<uint32_t>(side - before));
}

}  // namespace

Window RegionGroup::samplesOf(const Window& regions) const {
  const auto end = [&](uint32_t last, uint32_t count, uint32_t side) {
    return last == count ? side : last << side_log2;
  };
  const uint32_t x = regions.x << side_log2, y = regions.y << side_log2;
  return {x, y, end(regions.x + regions.width, columns, plane.width) - x,
          end(regions.y + regions.height, rows, plane.height) - y};
}

Window RegionGroup::meeting(const Window& samples) const {
  assert(samples.isInside(plane));
  const auto at = [&](uint32_t sample, uint32_t count) {
    return static_cast<uint32_t>(std::min<uint64_t>(uint64_t{sample} >> side_log2, count - 1));
  };
  const uint32_t x = at(samples.x, columns), y = at(samples.y, rows);
  return {x, y, at(samples.x + samples.width - 1, columns) + 1 - x,
          at(samples.y + samples.height - 1, rows) + 1 - y};
}

std::vector<RegionGroup> regionGroups(Extent plane, int side_log2) {
  std::vector<RegionGroup> groups;
  for (int log2 = side_log2; log2 > 0; log2 += kRegionLevels) {
    assert(log2 <= kMostRegionLog2 + 32);  // sides are 32-bit numbers: larger regions are single
    const uint32_t columns = regionsAlong(plane.width, log2);
    const uint32_t rows = regionsAlong(plane.height, log2);
    if (columns == 1 && rows == 1) break;
    groups.push_back({log2, columns, rows, 0, plane});
  }
  uint64_t first = 1;
  for (auto group = groups.rbegin(); group != groups.rend(); ++group) {
    group->first = first;
    first += uint64_t{group->columns} * group->rows;
  }
  return groups;
}

bool takesRegionMasks(Extent plane, int side_log2) {
  const size_t levels = kRegionLevels * regionGroups(plane, side_log2).size();
  return levels > 0 && std::min(plane.width, plane.height) > uint64_t{2} << levels;
}

namespace {

/// Of each of the patches of a plane.
std::vector<RegionGroup> groupsOfPatch(uint32_t width, uint32_t height, int side_log2,
                                       uint32_t patches) {
  assert(height % patches == 0);
  return regionGroups({width, height / patches}, side_log2);
}

/// Calls visit(samples) for the regions of a group, patch by patch.
template <class Visit>
void forEachRegion(const RegionGroup& group, uint32_t patches, const Visit& visit) {
  for (uint32_t patch = 0; patch < patches; ++patch) {
    for (uint32_t y = 0; y < group.rows; ++y) {
      for (uint32_t x = 0; x < group.columns; ++x) {
        Window samples = group.samplesOf(x, y);
        samples.y += patch * group.plane.height;
        visit(samples);
      }
    }
  }
}

}  // namespace

std::vector<Region> regionsOf(uint32_t width, uint32_t height, int side_log2, uint32_t patches) {
  const std::vector<RegionGroup> groups = groupsOfPatch(width, height, side_log2, patches);
  auto level = static_cast<int>(groups.size()) * kRegionLevels;
  std::vector<Region> regions;
  regions.reserve(regionCount(width, height, side_log2, patches));
  regions.push_back({level + 1, Region::kAll, 0, 0, width, height});
  for (auto group = groups.rbegin(); group != groups.rend(); ++group) {
    forEachRegion(*group, patches, [&](const Window& r) {
      regions.push_back(
          {level - kRegionLevels + 1, level, r.x, r.y, r.x + r.width, r.y + r.height});
    });
    level -= kRegionLevels;
  }
  assert(regions.size() == regionCount(width, height, side_log2, patches));
  return regions;
}

std::vector<Window> finestRegions(uint32_t width, uint32_t height, int side_log2,
                                  uint32_t patches) {
  std::vector<Window> regions;
  const std::vector<RegionGroup> groups = groupsOfPatch(width, height, side_log2, patches);
  if (groups.empty()) return regions;
  regions.reserve(finestRegionCount(width, height, side_log2, patches));
  forEachRegion(groups.front(), patches, [&](const Window& r) { regions.push_back(r); });
  return regions;
}

std::vector<Region> largestRegions(uint32_t width, uint32_t height, int side_log2,
                                   uint32_t patches) {
  std::vector<Region> regions;
  int level = 0;
  for (const RegionGroup& group : groupsOfPatch(width, height, side_log2, patches)) {
    regions.push_back({level + 1, level + kRegionLevels, 0, 0,
                       longestSide(width, group.columns, group.side_log2),
                       longestSide(height / patches, group.rows, group.side_log2)});
    level += kRegionLevels;
  }
  regions.push_back({level + 1, Region::kAll, 0, 0, width, height});
  return regions;
}

uint64_t regionCount(uint32_t width, uint32_t height, int side_log2, uint32_t patches) {
  uint64_t count = 1;
  for (const RegionGroup& group : groupsOfPatch(width, height, side_log2, patches))
    count += uint64_t{group.columns} * group.rows * patches;
  return count;
}

uint64_t finestRegionCount(uint32_t width, uint32_t height, int side_log2, uint32_t patches) {
  const std::vector<RegionGroup> groups = groupsOfPatch(width, height, side_log2, patches);
  return groups.empty() ? 0 : uint64_t{groups.front().columns} * groups.front().rows * patches;
}

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

/// The tiers that bands have: where none is divided the first one alone.
size_t tiersOf(const std::vector<BandPlan>& plan) {
  const auto isDivided = [](const BandPlan& band) { return band.tiers != nullptr; };
  return std::any_of(plan.begin(), plan.end(), isDivided) ? kPriorities : 1;
}

/// No pass has a greater key.
int greatestKey(const std::vector<BandPlan>& plan, int planes, size_t tiers) {
  int key = BandPlan::kNoKey;
  for (const BandPlan& band : plan)
    key = std::max({key, 16 * (planes - 1) + band.log_norm, band.key_floor});
  return key + 16 * (static_cast<int>(tiers) - 1);
}

}  // namespace

PassQueue::PassQueue(const std::vector<BandPlan>& plan, int planes)
    : tiers_(tiersOf(plan)),
      progress_(tiers_ * plan.size()),
      order_(greatestKey(plan, planes, tiers_)) {
  assert(planes >= 0 && plan.size() <= kMostBands);
  if (planes == 0) return;
  for (size_t band = 0; band < plan.size(); ++band) {
    for (uint8_t tier = 0; tier < tiers_; ++tier) {
      const uint32_t members = plan[band].members(tier);
      if (members == 0) continue;
      const Pass first = {static_cast<uint32_t>(band), tier, static_cast<uint8_t>(planes - 1),
                          PassKind::kLikely};
      progressOf(first) = {plan[band].log_norm + 16 * tier, plan[band].key_floor + 16 * tier,
                           plan[band].needed, members, 0};
      needed_ += plan[band].needed;
      push(first, 0);
    }
  }
  order_.settle();
}

void PassQueue::need(size_t band) {
  for (size_t tier = 0; tier < tiers_; ++tier) {
    Progress& progress = progress_[tiers_ * band + tier];
    needed_ += !progress.needed && progress.open > 0;
    progress.needed = true;
  }
}

void PassQueue::push(Pass pass, uint32_t significant) {
  Progress& progress = progressOf(pass);
  assert(significant <= progress.coefficients);
  const uint32_t rarity = progress.coefficients / std::max(significant, 1u);
  const auto density = std::min(static_cast<size_t>(std::bit_width(rarity)), kDensities - 1);
  pass.key = std::max(16 * pass.plane + progress.log_norm - delayOf(pass.kind, density),
                      progress.key_floor);
  ++progress.open;
  order_.add(pass);
}

void PassQueue::pop(const Band& band) {
  const Pass done = order_.front();
  order_.pop();
  if (--progressOf(done).open == 0) pushNext(done, band);
  order_.settle();
}

void PassQueue::pushNext(const Pass& done, const Band& band) {
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
    const bool needed = progressOf(done).needed;
    assert(needed_ >= needed);
    needed_ -= needed;
  }
}

}  // namespace tetrakis::inline track
