// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track_decoder.hpp"

#include "bitstream/pass_queue.hpp"
#include "bitstream/range_decoder.hpp"

namespace tetrakis {

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
    const Pass& pass = passes.front();
    const size_t band = pass.band;
    state.run(plan, band, pass.kind, pass.plane, io);
    if (io.stopped()) return state;
    passes.pop(state.bands[band]);
  }
  state.complete = true;
  return state;
}

}  // namespace tetrakis
