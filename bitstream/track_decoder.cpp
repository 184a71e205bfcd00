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
  bool blockBit(AdaptiveBit& model, uint32_t, uint32_t, int) { return decoder_.decode(model); }
  bool groupBit(AdaptiveBit& model, size_t, int) { return decoder_.decode(model); }
  bool placeBit(AdaptiveBit& model, size_t, uint32_t, int) { return decoder_.decode(model); }
  bool bandBit(AdaptiveBit& model, int) { return decoder_.decode(model); }
  bool stopped() const { return decoder_.exhausted(); }
  void learned(size_t, uint32_t, uint32_t, int) {}

 private:
  RangeDecoder decoder_;
};

}  // namespace

TrackState decodeTrack(const std::vector<BandPlan>& plan, int planes,
                       std::span<const uint8_t> codeword) {
  TrackState state(plan, planes);
  DecodingIo io(codeword);
  std::vector<Pass> passes = schedule(plan, planes);
  while (!passes.empty() && !plan[passes.back().band].needed) passes.pop_back();
  for (const Pass& pass : passes) {
    state.run(plan, pass, io);
    if (io.stopped()) return state;
  }
  state.complete = true;
  return state;
}

}  // namespace tetrakis
