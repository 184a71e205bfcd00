// SPDX-License-Identifier: Apache-2.0
// PassOrder holds passes and gives them back, greater keys first; of equal ones the higher plane,
// then the lower band, then the higher tier, then the lower kind.
//
// A pass is added only once passes before it have been taken, so that it is never ahead of what was
// given back, and its key is a small number: a list for each key, that of the greatest one divided
// by planes, is sorted when its turn comes (a bucket queue; R. Dial 1969). Forests have thousands
// of bands, and a heap of all their passes would take as long as the passes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bitstream/track/plane_pass.hpp"

namespace tetrakis::inline track {

/// Bands of a track, fewer than: a forest has some for each patch, of each colour plane.
inline constexpr size_t kMostBands = size_t{1} << 22;

/// Bit-planes a coefficient may have: magnitudes stay below 2^30.
inline constexpr int kMaxPlanes = 30;

/// A pass over a tier of a band.
struct Pass {
  uint32_t band;
  uint8_t tier;
  uint8_t plane;
  PassKind kind;
  /// 16 log2 of norm * 2^plane, less a delay, but at least BandPlan::key_floor; 16 more for each
  /// priority of the tier.
  int key = 0;
};

class PassOrder {
 public:
  /// greatest_key: no pass that is added has a greater one.
  explicit PassOrder(int greatest_key) : greatest_key_(greatest_key) {}

  bool empty() const { return count_ == 0; }
  uint64_t bytes() const;
  /// Passes may be added after pop(); then settle() finds the first one, which front() gives.
  void add(const Pass& pass);
  void settle();
  Pass front() const;
  void pop();

 private:
  /// All of a pass but its key: 5 bits of the plane, 22 of the band, 3 of the tier, 2 of the kind.
  /// Greater ones come first.
  using Rank = uint32_t;
  using Ranks = std::vector<Rank>;

  static Rank rankOf(const Pass& pass);
  void openKey();
  void sort(Ranks& ranks);

  int greatest_key_;
  std::vector<Ranks> keys_;               ///< of the keys from the greatest one down
  size_t closed_ = 0;                     ///< the first of them whose turn has not come
  std::array<Ranks, kMaxPlanes> planes_;  ///< of the key before that one
  size_t plane_ = 0;                      ///< that of the first pass, whose ranks are sorted
  size_t count_ = 0;
  Ranks spare_;
};

}  // namespace tetrakis::inline track
