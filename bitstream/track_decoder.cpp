// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track_decoder.hpp"

#include <utility>

namespace tetrakis {

namespace {

/// The decoder's side of PlanePass: every decision comes out of the codeword.
class DecodingIo {
 public:
  explicit DecodingIo(const RangeDecoder& decoder) : decoder_(decoder) {}
  bool magnitudeBit(AdaptiveBit& model, size_t, int) { return decoder_.decode(model); }
  bool signBit(AdaptiveBit& model, size_t, bool flip) { return decoder_.decode(model) != flip; }
  bool blockBit(AdaptiveBit& model, uint32_t, uint32_t, int) { return decoder_.decode(model); }
  bool groupBit(AdaptiveBit& model, size_t, int) { return decoder_.decode(model); }
  bool placeBit(AdaptiveBit& model, size_t, uint32_t, int) { return decoder_.decode(model); }
  bool bandBit(AdaptiveBit& model, int) { return decoder_.decode(model); }
  bool stopped() const { return decoder_.exhausted(); }
  void learned(size_t, uint32_t, uint32_t, int) {}
  const RangeDecoder& decoder() const { return decoder_; }

 private:
  RangeDecoder decoder_;
};

/// Up to the last one of a band that is needed.
std::vector<Pass> neededPasses(const std::vector<BandPlan>& plan, int planes) {
  std::vector<Pass> passes = schedule(plan, planes);
  while (!passes.empty() && !plan[passes.back().band].needed) passes.pop_back();
  return passes;
}

}  // namespace

TrackState decodeTrack(const std::vector<BandPlan>& plan, int planes,
                       std::span<const uint8_t> codeword) {
  TrackState state(plan, planes);
  DecodingIo io{RangeDecoder(codeword)};
  for (const Pass& pass : neededPasses(plan, planes)) {
    state.run(plan, pass, io);
    if (io.stopped()) return state;
  }
  state.complete = true;
  return state;
}

GrowingTrack::GrowingTrack(std::vector<BandPlan> plan, int planes)
    : plan_(std::move(plan)), passes_(neededPasses(plan_, planes)), state_(plan_, planes) {}

/// Takes back what a shorter prefix told of the pass in which it ended.
void GrowingTrack::restore() {
  const uint16_t band = passes_[next_].band;
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
  for (; next_ < passes_.size(); ++next_) {
    restore();
    DecodingIo io(*decoder_);
    state_.run(plan_, passes_[next_], io);
    if (io.stopped()) return state_;
    decoder_ = io.decoder();
    band_.reset();
  }
  state_.complete = true;
  return state_;
}

}  // namespace tetrakis
