// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/track_memory.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

namespace tetrakis::inline wavelet {

uint64_t bytesOf(const Codewords& codewords) {
  uint64_t bytes = 0;
  for (const auto& codeword : codewords) bytes += codeword.size();
  return bytes;
}

uint64_t TrackMemory::knownBytes(const Codewords& codewords) const {
  return passes_within ? std::min(*passes_within, bytesOf(codewords)) : bytesOf(codewords);
}

uint64_t TrackMemory::bytes() const {
  return std::accumulate(kept_.begin(), kept_.end(), uint64_t{0});
}

void TrackMemory::begin(size_t track, std::vector<BandPlan> plan, int planes) {
  if (all_levels)
    for (BandPlan& band : plan) band.needed = true;
  tracks_[track].emplace(std::move(plan), planes);
}

const TrackState& TrackMemory::decode(size_t track, std::span<const uint8_t> codeword) {
  assert(!passes_within || tracks_.size() == 1);
  used_[track] = calls_;
  return passes_within ? tracks_[track]->decodePasses(codeword, *passes_within)
                       : tracks_[track]->decode(codeword);
}

void TrackMemory::forgetOldest(uint64_t most) {
  uint64_t left = bytes();
  if (left <= most) return;
  std::vector<size_t> order(tracks_.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return used_[a] < used_[b]; });
  for (const size_t track : order) {
    if (left <= most) return;
    left -= std::exchange(kept_[track], 0);
    tracks_[track].reset();
  }
}

TrackMemory::Room::Room(TrackMemory* memory, size_t tracks) : memory_(memory), bytes_(0) {
  if (memory_ == nullptr) return;
  memory_->tracks_.resize(tracks);
  memory_->kept_.resize(tracks);
  memory_->used_.resize(tracks);
  ++memory_->calls_;
  memory_->forgetOldest(memory_->most_bytes - memory_->most_bytes / 4);
  bytes_ = memory_->bytes();
}

void TrackMemory::Room::keepIfFits(size_t track) {
  const uint64_t before = memory_->kept_[track], now = memory_->tracks_[track]->bytes();
  memory_->kept_[track] = now;
  if (bytes_.fetch_add(now - before) + now - before <= memory_->most_bytes) return;
  bytes_ -= now;
  memory_->kept_[track] = 0;
  memory_->tracks_[track].reset();
}

}  // namespace tetrakis::inline wavelet
