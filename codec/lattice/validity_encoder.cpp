// SPDX-License-Identifier: Apache-2.0
#include "codec/lattice/validity.hpp"

#include <cassert>

#include "bitstream/coder/range_encoder.hpp"

namespace tetrakis::inline lattice {

namespace {

class EncodingIo {
 public:
  explicit EncodingIo(std::span<const uint8_t> valid) : valid_(valid) {}
  uint64_t asked(const SampleLine& line) const { return lowBits(line.count); }
  bool bit(AdaptiveBit& model, size_t sample) {
    assert(valid_[sample] <= 1);
    encoder_.encode(model, valid_[sample] != 0);
    return valid_[sample] != 0;
  }
  uint32_t run(AdaptiveBit&, bool, uint32_t) { return 0; }
  bool stopped() const { return false; }
  uint64_t otherwise(uint64_t, uint64_t majority) const { return majority; }
  std::vector<uint8_t> finish() { return encoder_.finish(); }

 private:
  std::span<const uint8_t> valid_;
  RangeEncoder encoder_;
};

/// As a decoder reads it, one byte or more.
std::vector<uint8_t> finished(EncodingIo& io) {
  std::vector<uint8_t> codeword = io.finish();
  if (codeword.empty()) codeword.push_back(0);
  return codeword;
}

}  // namespace

std::vector<uint8_t> encodeValidity(const PlaneView<const uint8_t>& valid) {
  EncodingIo io(valid.values());
  ValidityPass<EncodingIo>(valid.extent(), io).run();
  return finished(io);
}

std::vector<uint8_t> encodeLateValidity(const PlaneView<const uint8_t>& valid, Mask lifted) {
  EncodingIo encoding(valid.values());
  const SharedBits bits = sharedBits(lifted, valid.extent());
  LateMaskIo<EncodingIo> io(encoding, bits.get());
  ValidityPass<LateMaskIo<EncodingIo>>(valid.extent(), io).run();
  return finished(encoding);
}

}  // namespace tetrakis::inline lattice
