// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/corrections/corrections_decoder.hpp"

#include "bitstream/coder/range_decoder.hpp"

namespace tetrakis::inline corrections {

namespace {

class DecodingIo {
 public:
  explicit DecodingIo(std::span<const uint8_t> codeword) : decoder_(codeword) {}
  bool more(AdaptiveBit& model, size_t, int) { return decoder_.decode(model); }
  bool negative(AdaptiveBit& model, size_t, bool flip) { return decoder_.decode(model) != flip; }
  bool high(AdaptiveBit& model, size_t, int) { return decoder_.decode(model); }
  bool low(size_t, int) { return decoder_.decodeEven(); }
  bool stopped() const { return decoder_.exhausted(); }

 private:
  RangeDecoder decoder_;
};

}  // namespace

DecodedCorrections decodeCorrections(std::span<const uint8_t> codeword,
                                     const CorrectionHints& hints) {
  DecodedCorrections corrections{std::vector<int32_t>(hints.extent().samples(), 0)};
  DecodingIo io(codeword);
  corrections.decided = CorrectionPass<DecodingIo>(hints, io).run(corrections.values);
  return corrections;
}

}  // namespace tetrakis::inline corrections
