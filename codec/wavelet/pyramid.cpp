// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/pyramid.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace tetrakis::inline wavelet {

namespace {

LowBand split(const LowBand& whole) {
  LowBand low = whole;
  const auto split_side = [](uint32_t& side, int& splits) {
    if (side <= kSmallestSide) return;
    side -= side / 2;
    ++splits;
  };
  split_side(low.extent.width, low.splits_x);
  split_side(low.extent.height, low.splits_y);
  low.patch_rows = low.extent.height;
  return low;
}

}  // namespace

Pyramid::Pyramid(SampleMarks valid, Extent plane, HeldSamples held, int most_levels)
    : valid_(std::move(valid)), held_(held), lows_{{plane, plane.height, 0, 0}} {
  assert(plane.samples() > 0);
  assert(held.none() || held.numbers.size() == plane.samples());
  splitAll(most_levels);
  addSubbands();
  assert(subbands_.size() == kBandsPerLevel * static_cast<size_t>(levels()) + 1);
}

Pyramid::Pyramid(const Forest& forest, HeldSamples held)
    : owned_(std::make_shared<const OwnedSides>(forest)),
      held_(held),
      lows_{{{forest.side(), forest.side()}, forest.side(), 0, 0}} {
  splitAll(kMaxLevels);
  addSubbands();
  const size_t of_patch = subbands_.size();
  subbands_.reserve(forest.patches() * of_patch);
  for (uint32_t patch = 1; patch < forest.patches(); ++patch) {
    for (size_t i = 0; i < of_patch; ++i) {
      Subband& subband = subbands_.emplace_back(subbands_[i]);
      subband.patch = patch;
      subband.patch_row = patch * forest.side();
    }
  }
  for (LowBand& low : lows_) low.extent.height *= forest.patches();
}

uint64_t Pyramid::bytesOf(const Forest& forest) {
  const size_t of_patch = Pyramid({forest.side(), forest.side()}).subbands().size();
  return forest.patches() * (sizeof(uint16_t) + of_patch * sizeof(Subband));
}

void Pyramid::splitAll(int most_levels) {
  while (levels() < most_levels &&
         std::max(lows_.back().extent.width, lows_.back().extent.height) > kSmallestSide)
    lows_.push_back(split(lows_.back()));
  assert(levels() <= kMaxLevels);
}

void Pyramid::addSubbands() {
  const LowBand& coarsest = lows_.back();
  subbands_.push_back({levels(), Orientation::kLL, coarsest.extent.width, coarsest.extent.height, 0,
                       0, coarsest.splits_x, coarsest.splits_y});
  for (int level = levels(); level >= 1; --level) addSubbands(level);
}

void Pyramid::addSubbands(int level) {
  const Extent whole = low(level - 1).extent;
  const LowBand& band = low(level);
  const auto [width, height] = band.extent;
  const uint32_t high_width = whole.width - width, high_height = whole.height - height;
  const uint32_t high_y = uint32_t{1} << std::max(band.splits_y - 1, 0);
  const auto add = [&](Orientation orientation, Extent extent, uint32_t x, uint32_t y) {
    subbands_.push_back(
        {level, orientation, extent.width, extent.height, x, y, band.splits_x, band.splits_y});
  };
  add(Orientation::kHL, {high_width, height}, width, 0);
  add(Orientation::kLH, {width, high_height}, 0, high_y);
  add(Orientation::kHH, {high_width, high_height}, width, high_y);
}

std::vector<uint8_t> Pyramid::splitMask(int level, const Window& block) const {
  const LowBand& band = low(level);
  const bool split_rows = level < levels() && splitsX(level + 1);
  assert(!allExist() && block.isInside(band.extent));
  assert(!split_rows || block.x % 2 == 0);
  const uint32_t lows = split_rows ? block.width - block.width / 2 : block.width;
  const uint32_t pitch = (split_rows ? 2u : 1u) << band.splits_x, first = block.x << band.splits_x;
  std::vector<uint8_t> mask(block.extent().samples());
  uint8_t* to = mask.data();
  for (uint32_t y = block.y; y < block.y + block.height; ++y) {
    const uint32_t row = y << band.splits_y;
    for (uint32_t x = 0; x < lows; ++x) *to++ = valid_.at(level, first + x * pitch, row);
    for (uint32_t x = 0; x < block.width - lows; ++x)
      *to++ = valid_.at(level, first + x * pitch + pitch / 2, row);
  }
  assert(to == mask.data() + mask.size());
  return mask;
}

}  // namespace tetrakis::inline wavelet
