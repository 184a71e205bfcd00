// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/region_decoder.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/parallel.hpp"

namespace tetrakis::inline wavelet {

namespace {

constexpr uint64_t kOnce = 80 << 10;  // plans, models and the order of passes
constexpr uint64_t kBand = 512;       // a band of a plane, and its plan, without coefficients

/// The bands of a track, marked by what the view needs of each plane of them.
std::vector<BandPlan> marked(std::vector<BandPlan> plan, const std::vector<bool>& needs) {
  assert(plan.size() % needs.size() == 0);
  for (size_t i = 0; i < plan.size(); ++i) plan[i].needed = needs[i % needs.size()];
  return plan;
}

}  // namespace

uint64_t TrackNeeds::ofBands(const std::vector<BandPart>& parts) const {
  uint64_t sum = 0;
  for (const BandPart& part : parts) {
    if (known) sum += planes * Band::bytesOf(part.shape(), masked);
    if (masked) sum += planes * part.shape().wordCells() * sizeof(uint32_t);  // of the plan
    if (ordered) sum += BandTiers::bytesOf(part.shape());  // likewise, of all planes
  }
  return sum;
}

/// Each patch has bands of its own, many of them small, and all patches are in the base.
uint64_t TrackNeeds::ofForest() const {
  const Pyramid patch({forest->side(), forest->side()});
  std::vector<Region> regions =
      largestRegions(plane.width, plane.height, side_log2, forest->patches());
  const uint64_t bands = ofBands(partsOf(patch.subbands(), regions.back()));
  const uint64_t each = bands + kBand * (planes + 1) * patch.subbands().size();
  const uint64_t base = kOnce + forest->patches() * each;
  regions.pop_back();
  uint64_t most = 0;
  for (const Region& region : regions)
    most = std::max(most, kOnce + ofBands(partsOf(patch.subbands(), region)));
  const uint64_t others = regionCount(plane.width, plane.height, side_log2, forest->patches()) - 1;
  const uint64_t at_a_time = std::clamp<uint64_t>(threads, 1, others + 1);
  return kept ? base + others * most : std::max(base, most) + (at_a_time - 1) * most;
}

uint64_t TrackNeeds::bytes() const {
  if (forest != nullptr) return ofForest();
  const Pyramid pyramid(plane);
  uint64_t most = 0;
  const uint64_t count = regionCount(plane.width, plane.height, side_log2);
  for (const Region& region : largestRegions(plane.width, plane.height, side_log2))
    most = std::max(most, kOnce + ofBands(partsOf(pyramid.subbands(), region)));
  return kept ? most * count : most * std::clamp<uint64_t>(threads, 1, count);
}

bool RegionDecoder::nothingKnown(const Codewords& codewords) const {
  return regions.side_log2 == 0 && (bit_planes == 0 || codewords.front().empty());
}

int RegionDecoder::run(const Codewords& codewords, const TrackBands& bands,
                       const Take& take) const {
  assert(!codewords.empty());
  // Windows do not decode all tracks, so that only the bytes say how much is known.
  TrackMemory* const memory =
      context.memory != nullptr && !context.memory->forgets ? context.memory : nullptr;
  const uint64_t bytes = memory != nullptr ? memory->knownBytes(codewords) : bytesOf(codewords);
  const int fraction_bits = fractionBitsOf(wavelet, bit_planes, bytes, level);
  const int more_bits = fraction_bits - wavelet.fraction_bits;
  if (nothingKnown(codewords)) return fraction_bits;
  assert(memory == nullptr || !memory->passes_within || codewords.size() == 1);
  KeptItems<GrowingTrack>::Call call(memory != nullptr ? &memory->tracks : nullptr,
                                     codewords.size());
  parallelFor(context.threads, codewords.size(), [&](size_t i) {
    if (codewords[i].empty() || bit_planes == 0) return;
    const std::vector<bool> needs = bands.needs(i);
    if (needs.empty()) return;
    const auto plan = [&] { return marked(bands.plan(i), needs); };
    if (memory == nullptr) return take(i, decodeTrack(plan(), bit_planes, codewords[i]), more_bits);
    std::optional<GrowingTrack>& track = call.at(i);
    if (track) {
      track->need(needs);
    } else {
      track = memory->begun(plan(), bit_planes);
    }
    take(i, memory->decode(*track, codewords[i]), more_bits);
    call.keepIfFits(i);
  });
  return fraction_bits;
}

}  // namespace tetrakis::inline wavelet
