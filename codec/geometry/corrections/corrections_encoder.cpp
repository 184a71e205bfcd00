// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/corrections/corrections_encoder.hpp"

#include <cassert>

#include "bitstream/coder/range_encoder.hpp"

namespace tetrakis::inline corrections {

namespace {

class EncodingIo {
 public:
  explicit EncodingIo(std::span<const int32_t> corrections) : corrections_(corrections) {}
  bool more(AdaptiveBit& model, size_t sample, int depth) {
    const bool bit = static_cast<int>(std::bit_width(magnitude(sample))) > depth;
    encoder_.encode(model, bit);
    return bit;
  }
  bool negative(AdaptiveBit& model, size_t sample, bool flip) {
    const bool negative = corrections_[sample] < 0;
    encoder_.encode(model, negative != flip);
    return negative;
  }
  bool high(AdaptiveBit& model, size_t sample, int position) {
    const bool bit = (magnitude(sample) >> position) & 1;
    encoder_.encode(model, bit);
    return bit;
  }
  bool low(size_t sample, int position) {
    const bool bit = (magnitude(sample) >> position) & 1;
    encoder_.encodeEven(bit);
    return bit;
  }
  bool stopped() const { return false; }
  void take(size_t, std::span<const int32_t>) {}
  std::vector<uint8_t> finish() { return encoder_.finish(); }

 private:
  uint32_t magnitude(size_t sample) const {
    const auto bits = static_cast<uint32_t>(corrections_[sample]);
    return corrections_[sample] < 0 ? 0u - bits : bits;
  }

  std::span<const int32_t> corrections_;
  RangeEncoder encoder_;
};

}  // namespace

std::vector<uint8_t> encodeCorrections(std::span<const int32_t> corrections,
                                       const CorrectionHints& hints) {
  assert(corrections.size() == hints.extent().samples());
  EncodingIo io(corrections);
  CorrectionPass<EncodingIo>(hints, io).run();
  return io.finish();
}

}  // namespace tetrakis::inline corrections
