// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/track_decoder.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace tetrakis::inline track {

namespace {

/// The decoder's side of PlanePass: every decision comes out of the codeword.
template <class Decoder>
struct Decisions {
  Decoder decoder;

  bool magnitudeBit(AdaptiveBit& model, size_t, int) { return decoder.decode(model); }
  bool refinedBit(AdaptiveBit& model, size_t, int) { return decoder.decodeUncertain(model); }
  bool signBit(AdaptiveBit& model, size_t, bool flip) {
    return decoder.decodeUncertain(model) != flip;
  }
  bool groupBit(AdaptiveBit& model, size_t, int) { return decoder.decode(model); }
  bool placeBit(AdaptiveBit& model, size_t, uint32_t, int) {
    return decoder.decodeUncertain(model);
  }
  void learned(size_t, uint32_t, uint32_t, int) {}
};

struct DecodingIo;

/// The Io of a pass while bytes are far from missing.
struct PlentyIo : Decisions<RangeDecoder::Plenty> {
  explicit PlentyIo(DecodingIo& io);
  static constexpr bool stopped() { return false; }
};

struct DecodingIo : Decisions<RangeDecoder> {
  using Plenty = PlentyIo;
  bool blockBit(AdaptiveBit& model, uint32_t, uint32_t, int) { return decoder.decode(model); }
  bool bandBit(AdaptiveBit& model, int) { return decoder.decode(model); }
  bool stopped() const { return decoder.exhausted(); }
  bool hasPlenty(size_t decisions) const { return decoder.hasPlenty(decisions); }
};

PlentyIo::PlentyIo(DecodingIo& io) : Decisions{RangeDecoder::Plenty(io.decoder)} {}

/// What a band holds, without its tiers.
uint64_t bytesOf(const Band& band) {
  const uint64_t words = band.significant.size() + band.visited.size() + band.absent.size();
  return (band.magnitude.size() + words) * sizeof(uint32_t) + band.scaled.size() +
         band.sign.size() + band.block_nonzero.size();
}

}  // namespace

TrackState decodeTrack(const std::vector<BandPlan>& plan, int planes,
                       std::span<const uint8_t> codeword) {
  TrackState state(plan, planes);
  DecodingIo io{{RangeDecoder(codeword)}};
  PassQueue passes(plan, planes);
  while (passes.needed()) {
    const Pass pass = passes.front();
    state.run(plan, pass, io);
    if (io.stopped()) return state;
    assert(pass.band < state.bands.size());
    passes.pop(state.bands[pass.band]);
  }
  state.complete = true;
  return state;
}

GrowingTrack::GrowingTrack(std::vector<BandPlan> plan, int planes)
    : plan_(std::move(plan)), planes_(planes), passes_(plan_, planes), state_(plan_, planes) {}

/// Takes back what a shorter prefix told of the pass in which it ended.
void GrowingTrack::goOn(std::span<const uint8_t> codeword) {
  ended_ = false;
  if (!decoder_ || decoder_->exhausted() || lost_) {
    if (lost_) {
      passes_ = PassQueue(plan_, planes_);
      state_ = TrackState(plan_, planes_);
      lost_ = false;
    }
    decoder_.emplace(codeword);
  } else {
    decoder_->grow(codeword, read_);
  }
  read_ = decoder_->read(codeword);
  if (!band_) return;
  const uint32_t band = passes_.front().band;
  state_.bands[band] = std::move(*band_);
  state_.models[plan_[band].models] = *models_;
  band_.reset();
}

void GrowingTrack::keep() {
  const uint32_t band = passes_.front().band;
  band_ = state_.bands[band];
  models_ = state_.models[plan_[band].models];
}

/// A copy of the band before each pass would take as long as the passes. So only those are kept in
/// which the codeword is likely to end; where it ends in another one, the next call starts anew.
bool GrowingTrack::mayEnd() const {
  constexpr size_t kLeast = 64, kTimes = 4;
  return bytes_ - read_ <= kLeast + kTimes * longest_;
}

const TrackState& GrowingTrack::decode(std::span<const uint8_t> codeword) {
  if (codeword.size() < bytes_) *this = GrowingTrack(std::move(plan_), planes_);
  const bool known = decoder_ && codeword.size() == bytes_;
  if (known && (ended_ || !passes_.needed())) return state_;
  bytes_ = codeword.size();
  goOn(codeword);
  while (passes_.needed()) {
    if (mayEnd()) keep();
    const Pass pass = passes_.front();
    DecodingIo io{{*decoder_}};
    state_.run(plan_, pass, io);
    if (io.stopped()) {
      lost_ = !band_;
      ended_ = true;
      return state_;
    }
    decoder_ = io.decoder;
    const size_t before = std::exchange(read_, decoder_->read(codeword));
    longest_ = std::max(longest_, read_ - before);
    passes_.pop(state_.bands[pass.band]);
    band_.reset();
  }
  state_.complete = true;
  return state_;
}

void GrowingTrack::need(const std::vector<bool>& parts) {
  for (size_t band = 0; band < plan_.size(); ++band) {
    if (plan_[band].needed || !parts[band % parts.size()]) continue;
    plan_[band].needed = true;
    passes_.need(band);
  }
  state_.complete &= !passes_.needed();
}

const TrackState& GrowingTrack::decodePasses(std::span<const uint8_t> codeword, uint64_t bytes) {
  if (!decoder_) decoder_.emplace(codeword);
  DecodingIo io{{*decoder_}};
  while (passes_.needed() && io.decoder.read(codeword) < bytes) {
    const Pass pass = passes_.front();
    state_.run(plan_, pass, io);
    if (io.stopped()) break;
    passes_.pop(state_.bands[pass.band]);
  }
  decoder_ = io.decoder;
  state_.complete = !passes_.needed();
  return state_;
}

uint64_t GrowingTrack::bytes() const {
  uint64_t sum = (state_.models.size() + 1) * sizeof(BandModels) + passes_.bytes();
  for (const BandPlan& band : plan_) {
    sum += band.absent.size() * sizeof(uint32_t);
    if (band.tiers != nullptr) sum += band.tiers->bytes();
  }
  for (const Band& band : state_.bands) sum += bytesOf(band);
  return sum + (band_ ? bytesOf(*band_) : 0);
}

}  // namespace tetrakis::inline track
