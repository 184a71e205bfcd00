// SPDX-License-Identifier: Apache-2.0
#include "base/forest.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>
#include <utility>

namespace tetrakis::inline base {

namespace {

enum Side : uint32_t { kNorth, kEast, kSouth, kWest };
enum Corner : uint32_t { kNw, kNe, kSe, kSw };

/// The corners that a side begins and ends at.
constexpr std::array<std::array<uint32_t, 2>, Forest::kSides> kEnds = {
    {{kNw, kNe}, {kNe, kSe}, {kSw, kSe}, {kNw, kSw}}};

bool runsClockwise(uint32_t side) {
  return side % Forest::kSides < kSouth;
}

bool reversed(uint32_t a, uint32_t b) {
  return runsClockwise(a) == runsClockwise(b);
}

uint32_t endOf(uint32_t side, bool second) {
  return side - side % Forest::kSides + kEnds[side % Forest::kSides][second];
}

/// x within 0 … n, mirrored about both.
int64_t folded(int64_t x, int64_t n) {
  if (x >= 0 && x <= n) return x;
  const int64_t period = 2 * n;
  x = ((x % period) + period) % period;
  return std::min(x, period - x);
}

bool isOutside(int64_t x, int64_t n) {
  return x < 0 || x > n;
}

}  // namespace

bool Forest::isSound(std::span<const uint32_t> sides) {
  if (sides.empty() || sides.size() % kSides != 0) return false;
  for (uint32_t i = 0; i < sides.size(); ++i) {
    if (sides[i] == kBorder) continue;
    if (sides[i] >= sides.size() || sides[i] == i || sides[sides[i]] != i) return false;
  }
  return true;
}

Forest::Forest(int depth, std::vector<uint32_t> sides)
    : depth_(depth),
      sides_(std::move(sides)),
      corner_owners_(sides_.size()),
      straight_(sides_.size()) {
  assert(depth >= 1 && depth <= kMostDepth && isSound(sides_));
  joinCorners();
}

/// Sets of corners, each named by its lowest one, grow along all sides that are glued.
void Forest::joinCorners() {
  std::iota(corner_owners_.begin(), corner_owners_.end(), 0u);
  const auto root = [&](uint32_t corner) {
    while (corner_owners_[corner] != corner)
      corner = corner_owners_[corner] = corner_owners_[corner_owners_[corner]];
    return corner;
  };
  for (uint32_t a = 0; a < sides_.size(); ++a) {
    const uint32_t b = sides_[a];
    if (b == kBorder) continue;
    for (const bool second : {false, true}) {
      const uint32_t one = root(endOf(a, second)), other = root(endOf(b, second != reversed(a, b)));
      corner_owners_[std::max(one, other)] = std::min(one, other);
    }
  }
  std::vector<uint32_t> corners(sides_.size());
  std::vector<uint8_t> ends(sides_.size());  // at a border
  for (uint32_t i = 0; i < sides_.size(); ++i) {
    corner_owners_[i] = root(i);
    ++corners[corner_owners_[i]];
  }
  for (uint32_t side = 0; side < sides_.size(); ++side) {
    for (const bool second : {false, true})
      ends[corner_owners_[endOf(side, second)]] |= sides_[side] == kBorder;
  }
  for (uint32_t i = 0; i < sides_.size(); ++i)
    straight_[i] = corners[corner_owners_[i]] == kSides && ends[corner_owners_[i]] == 0;
}

Forest::Place Forest::across(int64_t n, uint32_t side, int64_t along, int64_t depth) const {
  const uint32_t other = sides_[side];
  return at(n, other, reversed(side, other) ? n - along : along, folded(depth, n));
}

Forest::Place Forest::at(int64_t n, uint32_t side, int64_t along, int64_t depth) {
  const uint32_t patch = side / kSides;
  switch (side % kSides) {
    case kNorth:
      return {patch, along, depth};
    case kEast:
      return {patch, n - depth, along};
    case kSouth:
      return {patch, along, n - depth};
    default:
      return {patch, depth, along};
  }
}

Forest::Place Forest::locate(int64_t n, Place place) const {
  for (;;) {
    auto& [patch, x, y] = place;
    const uint32_t first = patch * kSides;
    const uint32_t beside = first + (x < 0 ? kWest : kEast);
    const uint32_t above = first + (y < 0 ? kNorth : kSouth);
    if (isOutside(x, n) && sides_[beside] == kBorder) x = folded(x, n);
    if (isOutside(y, n) && sides_[above] == kBorder) y = folded(y, n);
    if (isOutside(x, n) && isOutside(y, n)) {
      const uint32_t corner = y < 0 ? (x < 0 ? kNw : kNe) : (x < 0 ? kSw : kSe);
      if (straight_[first + corner] == 0) y = folded(y, n);
    }
    if (isOutside(x, n))
      place = across(n, beside, y, x < 0 ? -x : x - n);
    else if (isOutside(y, n))
      place = across(n, above, x, y < 0 ? -y : y - n);
    else
      return place;
  }
}

Forest::Place Forest::owner(int64_t n, const Place& sample) const {
  const auto [patch, x, y] = sample;
  const uint32_t first = patch * kSides;
  const bool west = x == 0, east = x == n, north = y == 0, south = y == n;
  if ((west || east) && (north || south)) {
    const uint32_t corner = first + (north ? (west ? kNw : kNe) : (west ? kSw : kSe));
    const uint32_t owner = corner_owners_[corner], kind = owner % kSides;
    return {owner / kSides, kind == kNe || kind == kSe ? n : 0, kind == kSe || kind == kSw ? n : 0};
  }
  if (!west && !east && !north && !south) return sample;
  const uint32_t side = first + (north ? kNorth : east ? kEast : south ? kSouth : kWest);
  if (isOwner(side)) return sample;
  return across(n, side, north || south ? x : y, 0);
}

OwnedSides::OwnedSides(const Forest& forest)
    : last_(forest.side() - 1), owned_(forest.patches(), 0x1FF) {
  forest.forEachShared(2, [&](const Forest::Place& sample, const Forest::Place&) {
    owned_[sample.patch] &= static_cast<uint16_t>(~(1u << (3 * sample.y + sample.x)));
  });
}

uint32_t OwnedSides::every(int log2, uint32_t patch, uint32_t x, uint32_t y) const {
  const uint32_t of_row = owned_[patch] >> (y == 0 ? 0 : y == last_ ? 6 : 3);
  uint32_t word = (of_row & 2) != 0 ? ~uint32_t{0} : 0;
  if (x == 0) word = (word & ~uint32_t{1}) | (of_row & 1);
  const uint32_t end = (last_ - x) >> log2;
  if (x > last_ || end > 31 || x + (end << log2) != last_) return word;
  return (word & ~(uint32_t{1} << end)) | (of_row >> 2 & 1) << end;
}

BitPlane ownedSamples(const Forest& forest) {
  const uint32_t side = forest.side();
  BitPlane owned(forest.raster());
  owned.invert();
  forest.forEachShared(side - 1, [&](const Forest::Place& sample, const Forest::Place&) {
    const auto x = static_cast<uint32_t>(sample.x), y = static_cast<uint32_t>(sample.y);
    owned.row(sample.patch * side + y)[x / kWordBits] &= ~(uint64_t{1} << x % kWordBits);
  });
  return owned;
}

}  // namespace tetrakis::inline base
