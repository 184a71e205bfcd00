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

/// Of a pass over a tier, which goes on where the bytes end in it.
struct DecodingIo : Decisions<RangeDecoder> {
  using Plenty = PlentyIo;

  const Band& band;
  size_t tier;
  const BandModels& models;
  std::optional<BeforeRow>& stop;

  bool blockBit(AdaptiveBit& model, uint32_t, uint32_t, int) { return decoder.decode(model); }
  bool bandBit(AdaptiveBit& model, int) { return decoder.decode(model); }
  bool stopped() const { return decoder.exhausted(); }
  bool hasPlenty(size_t decisions) const { return decoder.hasPlenty(decisions); }
  void mayStopAt(PassPlace place) { stop.emplace(decoder, band, tier, models, place); }
};

PlentyIo::PlentyIo(DecodingIo& io) : Decisions{RangeDecoder::Plenty(io.decoder)} {}

/// What a band holds, without its tiers.
uint64_t bytesOf(const Band& band) {
  const uint64_t words = band.significant.size() + band.visited.size() + band.absent.size();
  return (band.magnitude.size() + words) * sizeof(uint32_t) + band.scaled.size() +
         band.sign.size() + band.block_nonzero.size();
}

}  // namespace

TrackState decodeTrack(std::vector<BandPlan> plan, int planes, std::span<const uint8_t> codeword) {
  GrowingTrack track(std::move(plan), planes);
  track.decode(codeword);
  return std::move(track).state();
}

BeforeRow::BeforeRow(const RangeDecoder& decoder, const Band& band, size_t tier,
                     const BandModels& models, PassPlace place)
    : decoder_(decoder), models_(models), place_(place), tier_(band.tier_states[tier]) {
  const size_t word = band.shape.word(place.row, place.word);
  significant_ = band.significant[word];
  visited_ = band.visited[word];
  if (!band.hasCells()) return;
  const size_t cell = band.shape.cell(place.row, kColumns * place.word);
  std::copy_n(band.magnitude.data() + cell, kColumns, magnitude_.begin());
  std::copy_n(band.scaled.data() + cell, kColumns, scaled_.begin());
  std::copy_n(band.sign.data() + cell, kColumns, sign_.begin());
}

void BeforeRow::restore(Band& band, size_t tier, BandModels& models) const {
  models = models_;
  band.tier_states[tier] = tier_;
  const size_t word = band.shape.word(place_.row, place_.word);
  band.significant[word] = significant_;
  band.visited[word] = visited_;
  if (!band.hasCells()) return;
  const size_t cell = band.shape.cell(place_.row, kColumns * place_.word);
  std::copy(magnitude_.begin(), magnitude_.end(), band.magnitude.data() + cell);
  std::copy(scaled_.begin(), scaled_.end(), band.scaled.data() + cell);
  std::copy(sign_.begin(), sign_.end(), band.sign.data() + cell);
}

GrowingTrack::GrowingTrack(std::vector<BandPlan> plan, int planes)
    : plan_(std::move(plan)), planes_(planes), passes_(plan_, planes), state_(plan_, planes) {}

/// Takes back what a shorter prefix told of the row in which it ended.
void GrowingTrack::goOn(std::span<const uint8_t> codeword) {
  if (stop_) {
    const Pass pass = passes_.front();
    stop_->restore(state_.bands[pass.band], pass.tier, state_.models[plan_[pass.band].models]);
    decoder_ = stop_->decoder();
  }
  if (!decoder_ || decoder_->exhausted()) {
    decoder_.emplace(codeword);
  } else {
    decoder_->grow(codeword, read_);
  }
}

bool GrowingTrack::runNext() {
  const Pass pass = passes_.front();
  Band& band = state_.bands[pass.band];
  const PassPlace from = stop_ ? stop_->place() : PassPlace{};
  DecodingIo io{{*decoder_}, band, pass.tier, state_.models[plan_[pass.band].models], stop_};
  state_.run(plan_, pass, io, from);
  if (io.stopped()) return false;
  stop_.reset();
  decoder_ = io.decoder;
  passes_.pop(band);
  return true;
}

const TrackState& GrowingTrack::decode(std::span<const uint8_t> codeword) {
  if (codeword.size() < bytes_) *this = GrowingTrack(std::move(plan_), planes_);
  const bool known = decoder_ && codeword.size() == bytes_;
  if (known && (stop_ || !passes_.needed())) return state_;
  bytes_ = codeword.size();
  goOn(codeword);
  while (passes_.needed() && runNext()) continue;
  read_ = (stop_ ? stop_->decoder() : *decoder_).read(codeword);
  state_.complete = !passes_.needed();
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
  while (!stop_ && passes_.needed() && decoder_->read(codeword) < bytes) runNext();
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
  return sum;
}

}  // namespace tetrakis::inline track
