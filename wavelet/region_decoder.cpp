// SPDX-License-Identifier: Apache-2.0
#include "wavelet/region_decoder.hpp"

#include "bitstream/parallel.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis {

namespace {

/// Every decision is there: said by the number of bytes, because a window does not decode all
/// tracks.
bool isWhole(const RegionHeader& regions, const Codewords& codewords) {
  uint64_t bytes = 0;
  for (const auto& codeword : codewords) bytes += codeword.size();
  return regions.whole_bytes > 0 && bytes >= regions.whole_bytes;
}

}  // namespace

int RegionDecoder::run(const Codewords& codewords, const PlanOf& plan_of, const Take& take,
                       TrackMemory* memory) const {
  if (regions.side_log2 == 0) {
    const auto taken = [&](const TrackState& state) {
      const int bits = outputFractionBits(wavelet, planes, state.complete);
      take(0, state, bits - wavelet.fraction_bits);
      return bits;
    };
    // The plan is known when its masks are, which come first.
    if (memory == nullptr || codewords.front().empty())
      return taken(decodeTrack(plan_of(0), planes, codewords.front()));
    if (!*memory) memory->emplace(plan_of(0), planes);
    return taken((*memory)->decode(codewords.front()));
  }
  const int bits = outputFractionBits(wavelet, planes, isWhole(regions, codewords));
  parallelFor(threads, codewords.size(), [&](size_t i) {
    if (codewords[i].empty()) return;
    const std::vector<BandPlan> plan = plan_of(i);
    if (plan.empty()) return;
    take(i, decodeTrack(plan, planes, codewords[i]), bits - wavelet.fraction_bits);
  });
  return bits;
}

}  // namespace tetrakis
