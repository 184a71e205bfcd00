// SPDX-License-Identifier: Apache-2.0
#include "conformance/reference_decoder/forest.hpp"

#include <numeric>
#include <utility>

namespace tetrakis::reference {
namespace {

enum Side { kNorth, kEast, kSouth, kWest };

/// Numbers of the corners of a patch at sample 0 and at the last sample of each side.
constexpr int kEnds[4][2] = {{0, 1}, {1, 2}, {3, 2}, {0, 3}};

int cornerOf(bool east, bool south) {
  return south ? (east ? 2 : 3) : east;
}

bool isOutside(int64_t t, int64_t last) {
  return t < 0 || t > last;
}

/// "Mirrored about 0 and n, with period 2n"
int64_t fold(int64_t t, int64_t n) {
  if (!isOutside(t, n)) return t;
  t = (t % (2 * n) + 2 * n) % (2 * n);
  return t <= n ? t : 2 * n - t;
}

/// What lies so many rows or columns inside of a side, at sample `along` of it.
Place inside(int side, int64_t along, int64_t depth, int64_t last) {
  const int64_t patch = side / 4;
  switch (side % 4) {
    case kNorth:
      return {patch, along, depth};
    case kEast:
      return {patch, last - depth, along};
    case kSouth:
      return {patch, along, last - depth};
    default:
      return {patch, depth, along};
  }
}

/// parents: of each corner a lower one that is the same, or itself.
void join(int a, int b, std::vector<int>& parents) {
  const auto lowest = [&](int corner) {
    while (parents[corner] != corner) corner = parents[corner];
    return corner;
  };
  const int low = std::min(lowest(a), lowest(b));
  for (int corner : {a, b}) {
    while (corner != low) corner = std::exchange(parents[corner], low);
  }
}

}  // namespace

Forest::Forest(int depth, std::vector<int> glued)
    : depth_(depth), glued_(std::move(glued)), corners_(glued_.size()) {
  std::iota(corners_.begin(), corners_.end(), 0);
  const auto corner = [](int side, int64_t end) { return side / 4 * 4 + kEnds[side % 4][end]; };
  const int sides = static_cast<int>(glued_.size());
  for (int side = 0; side < sides; ++side) {
    for (const int end : {0, 1})
      join(corner(side, end), corner(glued_[side], across(side, end, 1)), corners_);
  }
  for (int& lowest : corners_) lowest = corners_[lowest];
  std::vector<int> meeting(sides);
  for (const int lowest : corners_) ++meeting[lowest];
  for (const int count : meeting) regular_.push_back(count == 4);
  for (int side = 0; side < sides; ++side) {
    for (const int end : {0, 1})
      if (glued_[side] == side) regular_[corners_[corner(side, end)]] = false;
  }
}

int64_t Forest::across(int side, int64_t along, int64_t last) const {
  const int other = glued_[side];
  const bool turns = (side % 4 < kSouth) == (other % 4 < kSouth);
  return turns && other != side ? last - along : along;
}

Place Forest::locate(Place p, int64_t lastX, int64_t lastY) const {
  for (;;) {
    const auto patch = static_cast<int>(4 * p.patch);
    const int sideX = patch + (p.x < 0 ? kWest : kEast),
              sideY = patch + (p.y < 0 ? kNorth : kSouth);
    if (glued_[sideX] == sideX) p.x = fold(p.x, lastX);
    if (glued_[sideY] == sideY) p.y = fold(p.y, lastY);
    const bool outX = isOutside(p.x, lastX);
    if (outX && isOutside(p.y, lastY) && !regular_[corners_[patch + cornerOf(p.x > 0, p.y > 0)]])
      p.y = fold(p.y, lastY);
    const bool outY = !outX && isOutside(p.y, lastY);
    if (!outX && !outY) return p;
    const int side = outX ? sideX : sideY;
    const int64_t along = outX ? p.y : p.x, beyond = outX ? p.x : p.y;
    const int64_t depth = fold(beyond < 0 ? -beyond : beyond - lastX, lastX);
    p = inside(glued_[side], across(side, along, lastX), depth, lastX);
  }
}

size_t Forest::ownerOf(size_t sample) const {
  if (isGrid()) return sample;
  const auto n = static_cast<int64_t>(side()) - 1, x = static_cast<int64_t>(sample % side()),
             row = static_cast<int64_t>(sample / side()), patch = row / (n + 1), y = row % (n + 1);
  const bool atX = x % n == 0, atY = y % n == 0;
  if (!atX && !atY) return sample;
  Place owner{patch, x, y};
  if (atX && atY) {
    const int corner = corners_[static_cast<int>(4 * patch) + cornerOf(x > 0, y > 0)];
    const bool east = corner % 4 == 1 || corner % 4 == 2;
    owner = {corner / 4, east ? n : 0, corner % 4 >= 2 ? n : 0};
  } else {
    const int side =
        static_cast<int>(4 * patch) + (atY ? (y > 0 ? kSouth : kNorth) : (x > 0 ? kEast : kWest));
    if (glued_[side] < side) owner = inside(glued_[side], across(side, atY ? x : y, n), 0, n);
  }
  return static_cast<size_t>((owner.patch * (n + 1) + owner.y) * (n + 1) + owner.x);
}

}  // namespace tetrakis::reference
