// SPDX-License-Identifier: Apache-2.0
#include "bitstream/track_decoder.hpp"

#include "bitstream/range_decoder.hpp"

namespace tetrakis {

namespace {

/// The decoder's side of PlanePass: every decision comes out of the codeword.
class DecodingIo {
 public:
  explicit DecodingIo(std::span<const uint8_t> codeword) : decoder_(codeword) {}
  bool magnitudeBit(AdaptiveBit& model, size_t, int) { return decoder_.decode(model); }
  bool signBit(AdaptiveBit& model, size_t, bool flip) { return decoder_.decode(model) != flip; }
  bool blockBit(AdaptiveBit& model, const CellRange&, int) { return decoder_.decode(model); }
  bool stopped() const { return decoder_.exhausted(); }
  void learned(const Band&, size_t, uint32_t, int) {}

 private:
  RangeDecoder decoder_;
};

}  // namespace

TrackState decodeTrack(const std::vector<BandPlan>& plan, int planes, const HintFactory& factory,
                       std::span<const uint8_t> codeword) {
  TrackState state(plan);
  std::vector<std::unique_ptr<HintSource>> hints;
  for (uint32_t band = 0; band < plan.size(); ++band) hints.push_back(factory.hints(state, band));
  DecodingIo io(codeword);
  for (const Pass& pass : schedule(plan, planes)) {
    PlanePass<DecodingIo>(state.bands[pass.band], state.models[plan[pass.band].models],
                          *hints[pass.band], io)
        .run(pass.kind, pass.plane);
    if (io.stopped()) return state;
  }
  state.complete = true;
  return state;
}

}  // namespace tetrakis
