// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track/track_decoder.hpp"

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

/// While bytes are far from missing.
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

}  // namespace

TrackState decodeTrack(const std::vector<BandPlan>& plan, int planes,
                       std::span<const uint8_t> codeword) {
  TrackState state(plan, planes);
  DecodingIo io{{RangeDecoder(codeword)}};
  PassQueue passes(plan, planes);
  while (passes.needed()) {
    const Pass pass = passes.front();
    state.run(plan, pass.band, pass.kind, pass.plane, io);
    if (io.stopped()) return state;
    assert(pass.band < state.bands.size());
    passes.pop(state.bands[pass.band]);
  }
  state.complete = true;
  return state;
}

GrowingTrack::GrowingTrack(std::vector<BandPlan> plan, int planes)
    : plan_(std::move(plan)), passes_(plan_, planes), state_(plan_, planes) {}

/// Takes back what a shorter prefix told of the pass in which it ended.
void GrowingTrack::restore() {
  assert(passes_.needed());
  const uint16_t band = passes_.front().band;
  if (band_) {
    state_.bands[band] = *band_;
    state_.models[plan_[band].models] = *models_;
  } else {
    band_ = state_.bands[band];
    models_ = state_.models[plan_[band].models];
  }
}

const TrackState& GrowingTrack::decode(std::span<const uint8_t> codeword) {
  if (decoder_) {
    decoder_->grow(codeword);
  } else {
    decoder_.emplace(codeword);
  }
  while (passes_.needed()) {
    restore();
    const Pass pass = passes_.front();
    DecodingIo io{{*decoder_}};
    state_.run(plan_, pass.band, pass.kind, pass.plane, io);
    if (io.stopped()) return state_;
    decoder_ = io.decoder;
    passes_.pop(state_.bands[pass.band]);
    band_.reset();
  }
  state_.complete = true;
  return state_;
}

}  // namespace tetrakis::inline track
