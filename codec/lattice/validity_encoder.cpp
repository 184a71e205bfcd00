// SPDX-License-Identifier: Apache-2.0
#include "codec/lattice/validity.hpp"

#include <cassert>

#include "bitstream/coder/range_encoder.hpp"

namespace tetrakis::inline lattice {

namespace {

/// Marks of samples by their number.
struct ByteMarks {
  std::span<const uint8_t> valid;
  bool operator[](size_t sample) const {
    assert(valid[sample] <= 1);
    return valid[sample] != 0;
  }
};
struct BitMarks {
  const BitPlane& valid;
  bool operator[](size_t sample) const {
    const uint32_t width = valid.extent().width;
    return valid.at(static_cast<uint32_t>(sample % width), static_cast<uint32_t>(sample / width));
  }
};

template <class Marks>
class EncodingIo {
 public:
  explicit EncodingIo(Marks valid) : valid_(valid) {}
  uint64_t asked(const SampleLine& line) const { return lowBits(line.count); }
  bool bit(AdaptiveBit& model, size_t sample) {
    const bool valid = valid_[sample];
    encoder_.encode(model, valid);
    return valid;
  }
  uint32_t run(AdaptiveBit&, bool, uint32_t) { return 0; }
  bool stopped() const { return false; }
  uint64_t otherwise(uint64_t, uint64_t majority) const { return majority; }
  std::vector<uint8_t> finish() { return encoder_.finish(); }

 private:
  Marks valid_;
  RangeEncoder encoder_;
};

/// As a decoder reads it, one byte or more.
template <class Io>
std::vector<uint8_t> finished(Io& io) {
  std::vector<uint8_t> codeword = io.finish();
  if (codeword.empty()) codeword.push_back(0);
  return codeword;
}

template <class Marks>
std::vector<uint8_t> encode(Extent plane, Marks valid) {
  EncodingIo<Marks> io(valid);
  ValidityPass<EncodingIo<Marks>>(plane, io).run();
  return finished(io);
}

}  // namespace

std::vector<uint8_t> encodeValidity(const PlaneView<const uint8_t>& valid) {
  return encode(valid.extent(), ByteMarks{valid.values()});
}

std::vector<uint8_t> encodeValidityBits(const BitPlane& valid) {
  return encode(valid.extent(), BitMarks{valid});
}

std::vector<uint8_t> encodeFinerValidity(const BitPlane& valid) {
  const Extent plane = valid.extent();
  if (decodeFinerValidity({}, plane, coarseMarks(valid)) == valid) return {};
  EncodingIo<BitMarks> io({valid});
  ValidityPass<EncodingIo<BitMarks>>(plane, io).refine(coarseMarks(valid), kFinerLevels);
  return finished(io);
}

std::vector<uint8_t> encodeLateValidity(const PlaneView<const uint8_t>& valid, Mask lifted) {
  EncodingIo<ByteMarks> encoding({valid.values()});
  const SharedBits bits = sharedBits(lifted, valid.extent());
  LateMaskIo<EncodingIo<ByteMarks>> io(encoding, bits.get());
  ValidityPass<LateMaskIo<EncodingIo<ByteMarks>>>(valid.extent(), io).run();
  return finished(encoding);
}

}  // namespace tetrakis::inline lattice
