// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/corrections/corrections_decoder.hpp"

#include "bitstream/coder/range_decoder.hpp"

namespace tetrakis::inline corrections {

namespace {

class DecodingIo {
 public:
  DecodingIo(std::span<const uint8_t> codeword, const TakeCorrections& take)
      : decoder_(codeword), take_(take) {}
  bool more(AdaptiveBit& model, size_t, int) { return decoder_.decode(model); }
  bool negative(AdaptiveBit& model, size_t, bool flip) { return decoder_.decode(model) != flip; }
  bool high(AdaptiveBit& model, size_t, int) { return decoder_.decode(model); }
  bool low(size_t, int) { return decoder_.decodeEven(); }
  bool stopped() const { return decoder_.exhausted(); }
  void take(size_t first, std::span<const int32_t> row) { take_(first, row); }

 private:
  RangeDecoder decoder_;
  const TakeCorrections& take_;
};

}  // namespace

void decodeCorrections(std::span<const uint8_t> codeword, const CorrectionHints& hints,
                       const TakeCorrections& take) {
  DecodingIo io(codeword, take);
  CorrectionPass<DecodingIo>(hints, io).run();
}

}  // namespace tetrakis::inline corrections
