// SPDX-License-Identifier: Apache-2.0
// A Forest is a surface of square patches whose sides are glued: a globe on a cube, a torus, a grid
// of squares (L. Balmelli, thesis, sections 3.2.2 and 4.6). It says which samples of which patches
// are one, and which sample lies where a line leaves a patch.
//
// A patch has (2^depth + 1)^2 samples. The raster of a forest holds the patches one below the
// other. Sides and corners are numbered clockwise, patch by patch, y pointing down:
//
//   side    4 patch + 0 north, 1 east, 2 south, 3 west      north and south run eastwards, east and
//   corner  4 patch + 0 nw, 1 ne, 2 se, 3 sw                west southwards
//
// Two sides that are glued run in opposite directions round their patches, so that the surface has
// two faces: where both run clockwise, or both do not, sample k of one side is sample n - k of the
// other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "base/bit_plane.hpp"
#include "base/plane.hpp"

namespace tetrakis::inline base {

class Forest {
 public:
  static constexpr uint32_t kBorder = UINT32_MAX;  ///< in the place of a side: none is glued here
  static constexpr uint32_t kSides = 4;
  static constexpr int kMostDepth = 18;
  static constexpr uint32_t kMostPatches = 4096, kMostRows = 1 << 20;

  /// The patches that a forest may have whose raster has no more than kMostRows rows.
  static uint32_t mostPatches(int depth) {
    return std::min(kMostPatches, kMostRows / ((uint32_t{1} << depth) + 1));
  }

  /// A sample of a patch, or of what lies around it.
  struct Place {
    uint32_t patch;
    int64_t x, y;
    bool operator==(const Place&) const = default;
  };

  /// Whether sides, four a patch, name each other or none, and no side itself.
  static bool isSound(std::span<const uint32_t> sides);

  /// sides: for each side the one that it is glued to, or kBorder; isSound().
  Forest(int depth, std::vector<uint32_t> sides);

  int depth() const { return depth_; }
  uint32_t patches() const { return static_cast<uint32_t>(sides_.size() / kSides); }
  const std::vector<uint32_t>& sides() const { return sides_; }
  /// The samples along a side of a patch.
  uint32_t side() const { return (uint32_t{1} << depth_) + 1; }
  Extent raster() const { return {side(), side() * patches()}; }
  bool operator==(const Forest& other) const {
    return depth_ == other.depth_ && sides_ == other.sides_;
  }

  /// The functions below see patches of (n + 1)^2 samples, with n even: those of a level.

  /// The sample where a line leaves a patch: straight across a glued side; mirrored at a border. A
  /// place that lies beyond a corner, where other than four patches meet, is mirrored in y. No
  /// patch is left twice in one direction: places farther than n are mirrored there.
  Place locate(int64_t n, Place place) const;

  /// Of the samples that are one with this sample of a patch the one that is coded: on a side that
  /// of the lower side, at a corner that of the lowest corner.
  Place owner(int64_t n, const Place& sample) const;

  /// Calls visit(sample, owner) for all samples of sides that others own.
  template <class Visit>
  void forEachShared(int64_t n, const Visit& visit) const {
    for (uint32_t patch = 0; patch < patches(); ++patch) {
      for (const auto& [x, y] : {std::pair(int64_t{0}, int64_t{0}), {n, 0}, {n, n}, {0, n}}) {
        const Place corner{patch, x, y}, owned = owner(n, corner);
        if (!(owned == corner)) visit(corner, owned);
      }
      for (uint32_t side = patch * kSides; side < (patch + 1) * kSides; ++side) {
        if (isOwner(side)) continue;
        for (int64_t k = 1; k < n; ++k) visit(at(n, side, k, 0), across(n, side, k, 0));
      }
    }
  }

 private:
  void joinCorners();
  /// Samples of the side are coded as such, not as those of the one that it is glued to.
  bool isOwner(uint32_t side) const { return sides_[side] == kBorder || sides_[side] > side; }
  /// The place at that depth within a patch, seen from a side, `along` counted as the side runs.
  static Place at(int64_t n, uint32_t side, int64_t along, int64_t depth);
  /// The place at that depth behind a side.
  Place across(int64_t n, uint32_t side, int64_t along, int64_t depth) const;

  int depth_;
  std::vector<uint32_t> sides_;
  std::vector<uint32_t> corner_owners_;  ///< for each corner the lowest one at the same place
  std::vector<uint8_t> straight_;        ///< 1 for each corner where four patches meet
};

using SharedForest = std::shared_ptr<const Forest>;

/// Of two that are both there, or not.
inline bool sameForest(const SharedForest& a, const SharedForest& b) {
  return a == b || (a != nullptr && b != nullptr && *a == *b);
}

/// Gives samples of a raster that others own the values of those: so many values each. n: as of
/// Forest.
template <class T>
void shareOwned(const Forest& forest, std::span<T> raster, uint32_t n, size_t values = 1) {
  const size_t width = size_t{n} + 1;
  const auto at = [&](const Forest::Place& place) {
    return raster.data() + values * ((place.patch * width + static_cast<size_t>(place.y)) * width +
                                     static_cast<size_t>(place.x));
  };
  forest.forEachShared(n, [&](const Forest::Place& sample, const Forest::Place& owner) {
    std::copy_n(at(owner), values, at(sample));
  });
}

/// Marks the samples of a raster that no other one owns.
BitPlane ownedSamples(const Forest& forest);

/// The same marks without a bit for each sample: only those at the sides of patches have other
/// owners.
class OwnedSides {
 public:
  explicit OwnedSides(const Forest& forest);

  /// 32 samples of a row of a patch of the raster that lie 2^log2 apart, from x on: a bit for each
  /// one that no other one owns.
  uint32_t every(int log2, uint32_t patch, uint32_t x, uint32_t y) const;

 private:
  uint32_t last_;                ///< column and row of a patch
  std::vector<uint16_t> owned_;  ///< of each patch; bit 3 j + i for 3 x 3 samples (i, j)
};

}  // namespace tetrakis::inline base
