// SPDX-License-Identifier: Apache-2.0
#include "codec/wavelet/region_decoder.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/parallel.hpp"

namespace tetrakis::inline wavelet {

namespace {

constexpr uint64_t kOnce = 64 << 10;  // plans and models
constexpr uint64_t kBand = 512;       // a band of a plane, and its plan, without coefficients

uint64_t bytesOf(const Codewords& codewords) {
  uint64_t bytes = 0;
  for (const auto& codeword : codewords) bytes += codeword.size();
  return bytes;
}

}  // namespace

uint64_t TrackMemory::knownBytes(const Codewords& codewords) const {
  return passes_within ? std::min(*passes_within, bytesOf(codewords)) : bytesOf(codewords);
}

const TrackState& TrackMemory::decode(size_t track, std::span<const uint8_t> codeword) {
  assert(!passes_within || tracks.size() == 1);
  return passes_within ? tracks[track]->decodePasses(codeword, *passes_within)
                       : tracks[track]->decode(codeword);
}

uint64_t TrackMemory::bytes() const {
  uint64_t sum = 0;
  for (const auto& one : tracks) sum += one ? one->bytes() : 0;
  return sum;
}

uint64_t TrackNeeds::ofBands(const std::vector<BandPart>& parts, uint64_t& largest) const {
  uint64_t sum = 0;
  for (const BandPart& part : parts) {
    const uint64_t one = known ? Band::bytesOf(part.shape(), masked) : 0;
    largest = std::max(largest, one);
    sum += planes * one;
    if (masked) sum += planes * part.shape().wordCells() * sizeof(uint32_t);  // of the plan
    if (ordered) sum += BandTiers::bytesOf(part.shape());  // likewise, of all planes
  }
  return sum;
}

/// Each patch has bands of its own, many of them small, and all are in one track.
uint64_t TrackNeeds::ofForest() const {
  const Pyramid patch({forest->side(), forest->side()});
  uint64_t largest = 0;
  const Region whole = largestRegions(plane.width, plane.width, 0).front();
  const uint64_t bands = ofBands(partsOf(patch.subbands(), whole), largest);
  const uint64_t each = bands + kBand * (planes + 1) * patch.subbands().size();
  return kOnce + forest->patches() * each + (kept ? largest : 0);
}

uint64_t TrackNeeds::bytes() const {
  if (forest != nullptr) return ofForest();
  const Pyramid pyramid(plane);
  uint64_t most = 0;
  const uint64_t count = regionCount(plane.width, plane.height, side_log2);
  for (const Region& region : largestRegions(plane.width, plane.height, side_log2)) {
    uint64_t band = 0;
    const uint64_t sum = kOnce + ofBands(partsOf(pyramid.subbands(), region), band);
    most = std::max(most, kept ? sum + band : sum);
  }
  return kept ? most * count : most * std::clamp<uint64_t>(threads, 1, count);
}

bool RegionDecoder::nothingKnown(const Codewords& codewords) const {
  return regions.side_log2 == 0 && (bit_planes == 0 || codewords.front().empty());
}

int RegionDecoder::run(const Codewords& codewords, const PlanOf& plan_of, const Take& take) const {
  assert(!codewords.empty());
  // Windows do not decode all tracks, so that only the bytes say how much is known.
  TrackMemory* const memory =
      context.memory != nullptr && !context.memory->forgets ? context.memory : nullptr;
  const uint64_t bytes = memory != nullptr ? memory->knownBytes(codewords) : bytesOf(codewords);
  const int fraction_bits = fractionBitsOf(wavelet, bit_planes, bytes, level);
  const int more_bits = fraction_bits - wavelet.fraction_bits;
  if (nothingKnown(codewords)) return fraction_bits;
  if (memory != nullptr) memory->tracks.resize(codewords.size());
  parallelFor(context.threads, codewords.size(), [&](size_t i) {
    if (codewords[i].empty() || bit_planes == 0) return;
    if (memory != nullptr && memory->tracks[i])
      return take(i, memory->decode(i, codewords[i]), more_bits);
    std::vector<BandPlan> plan = plan_of(i);
    if (plan.empty()) return;
    if (memory == nullptr) return take(i, decodeTrack(plan, bit_planes, codewords[i]), more_bits);
    if (memory->all_levels)
      for (BandPlan& band : plan) band.needed = true;
    memory->tracks[i].emplace(std::move(plan), bit_planes);
    take(i, memory->decode(i, codewords[i]), more_bits);
  });
  return fraction_bits;
}

}  // namespace tetrakis::inline wavelet
