// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/pass_order.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace tetrakis::inline track {

namespace {

constexpr int kPlaneShift = 27, kBandShift = 5, kTierShift = 2;
constexpr uint32_t kMostTier = 7, kMostKind = 3;

/// A digit of radix sort.
struct Digit {
  static constexpr int kBits = 9;
  static constexpr size_t kValues = size_t{1} << kBits;
  int shift;

  size_t of(uint32_t rank) const { return rank >> shift & (kValues - 1); }
};

}  // namespace

PassOrder::Rank PassOrder::rankOf(const Pass& pass) {
  assert(pass.plane < kMaxPlanes && pass.band < kMostBands && pass.tier <= kMostTier);
  const auto band = static_cast<uint32_t>(kMostBands - 1 - pass.band);
  return uint32_t{pass.plane} << kPlaneShift | band << kBandShift |
         uint32_t{pass.tier} << kTierShift | (kMostKind - static_cast<uint32_t>(pass.kind));
}

Pass PassOrder::front() const {
  assert(count_ > 0 && closed_ > 0);
  const Rank rank = planes_[plane_].back();
  return {static_cast<uint32_t>(kMostBands - 1 - (rank >> kBandShift & (kMostBands - 1))),
          static_cast<uint8_t>(rank >> kTierShift & kMostTier), static_cast<uint8_t>(plane_),
          static_cast<PassKind>(kMostKind - (rank & kMostKind)),
          greatest_key_ - static_cast<int>(closed_ - 1)};
}

uint64_t PassOrder::bytes() const {
  uint64_t ranks = spare_.capacity();
  for (const Ranks& of_key : keys_) ranks += of_key.capacity();
  for (const Ranks& of_plane : planes_) ranks += of_plane.capacity();
  return keys_.capacity() * sizeof(Ranks) + ranks * sizeof(Rank);
}

void PassOrder::add(const Pass& pass) {
  assert(pass.key <= greatest_key_);
  const auto key = static_cast<size_t>(greatest_key_ - pass.key);
  const Rank rank = rankOf(pass);
  ++count_;
  if (key >= closed_) {
    if (key >= keys_.size()) keys_.resize(key + 1);
    return keys_[key].push_back(rank);
  }
  assert(key + 1 == closed_ && pass.plane <= plane_);
  Ranks& ranks = planes_[pass.plane];
  const bool sorted = pass.plane == plane_;
  ranks.insert(sorted ? std::upper_bound(ranks.begin(), ranks.end(), rank) : ranks.end(), rank);
}

void PassOrder::pop() {
  assert(count_ > 0);
  planes_[plane_].pop_back();
  --count_;
}

void PassOrder::settle() {
  while (count_ > 0 && planes_[plane_].empty()) {
    if (plane_ == 0) {
      openKey();
    } else {
      --plane_;
    }
    sort(planes_[plane_]);
  }
}

void PassOrder::openKey() {
  const Ranks ranks = std::exchange(keys_[closed_++], {});
  for (const Rank rank : ranks) planes_[rank >> kPlaneShift].push_back(rank);
  plane_ = kMaxPlanes - 1;
}

/// Smaller ones first; all are of one plane.
void PassOrder::sort(Ranks& ranks) {
  constexpr size_t kFew = 64;
  if (ranks.size() < kFew) return std::sort(ranks.begin(), ranks.end());
  spare_.resize(ranks.size());
  for (int shift = 0; shift < kPlaneShift; shift += Digit::kBits) {
    const Digit digit{shift};
    std::array<uint32_t, Digit::kValues> ends{};
    for (const Rank rank : ranks) ++ends[digit.of(rank)];
    uint32_t begin = 0;
    for (uint32_t& end : ends) begin += std::exchange(end, begin);
    for (const Rank rank : ranks) spare_[ends[digit.of(rank)]++] = rank;
    ranks.swap(spare_);
  }
}

}  // namespace tetrakis::inline track
