// SPDX-License-Identifier: Apache-2.0
#include "codec/lattice/validity.hpp"

#include "bitstream/coder/range_decoder.hpp"

namespace tetrakis::inline lattice {

namespace {

class DecodingIo {
 public:
  explicit DecodingIo(std::span<const uint8_t> codeword) : decoder_(codeword) {}
  uint64_t asked(const SampleLine& line) const { return lowBits(line.count); }
  bool bit(AdaptiveBit& model, size_t) { return decoder_.decode(model); }
  uint32_t run(AdaptiveBit& model, bool valid, uint32_t most) {
    return decoder_.decodeRun(model, valid, most);
  }
  bool stopped() const { return decoder_.exhausted(); }
  uint64_t otherwise(uint64_t, uint64_t majority) const { return majority; }

 private:
  RangeDecoder decoder_;
};

}  // namespace

BitPlane decodeLateValidity(std::span<const uint8_t> codeword, Extent plane,
                            const SharedBits& lifted) {
  DecodingIo decoding(codeword);
  LateMaskIo<DecodingIo> io(decoding, lifted.get());
  return ValidityPass<LateMaskIo<DecodingIo>>(plane, io).run();
}

BitPlane decodeValidity(std::span<const uint8_t> codeword, Extent plane) {
  DecodingIo io(codeword);
  return ValidityPass<DecodingIo>(plane, io).run();
}

BitPlane decodeFinerValidity(std::span<const uint8_t> codeword, Extent plane, BitPlane coarse) {
  DecodingIo io(codeword);
  return ValidityPass<DecodingIo>(plane, io).refine(std::move(coarse), kFinerLevels);
}

BitPlane coarseMarks(const BitPlane& marks) {
  const Extent plane = marks.extent();
  BitPlane coarse({(plane.width + 7) / 8, (plane.height + 7) / 8});
  for (uint32_t y = 0; y < coarse.extent().height; ++y)
    for (uint32_t x = 0; x < coarse.extent().width; ++x)
      coarse.row(y)[x / kWordBits] |= uint64_t{marks.at(8 * x, 8 * y)} << x % kWordBits;
  return coarse;
}

}  // namespace tetrakis::inline lattice
