// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/track_memory.hpp"

#include <algorithm>
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

GrowingTrack TrackMemory::begun(std::vector<BandPlan> plan, int planes) const {
  if (all_levels)
    for (BandPlan& band : plan) band.needed = true;
  return {std::move(plan), planes};
}

const TrackState& TrackMemory::decode(GrowingTrack& track,
                                      std::span<const uint8_t> codeword) const {
  return passes_within ? track.decodePasses(codeword, *passes_within) : track.decode(codeword);
}

}  // namespace tetrakis::inline wavelet
