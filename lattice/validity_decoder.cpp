// SPDX-License-Identifier: Apache-2.0
#include "lattice/validity_decoder.hpp"

#include "bitstream/coder/range_decoder.hpp"
#include "lattice/validity_pass.hpp"

namespace tetrakis::inline lattice {

namespace {

class DecodingIo {
 public:
  explicit DecodingIo(std::span<const uint8_t> codeword) : decoder_(codeword) {}
  bool bit(AdaptiveBit& model, size_t) { return decoder_.decode(model); }
  bool stopped() const { return decoder_.exhausted(); }

 private:
  RangeDecoder decoder_;
};

}  // namespace

std::vector<uint8_t> decodeLateValidity(std::span<const uint8_t> codeword, Extent plane,
                                        Mask lifted) {
  std::vector<uint8_t> valid(plane.samples());
  DecodingIo decoding(codeword);
  LateMaskIo<DecodingIo> io(decoding, lifted);
  ValidityPass<LateMaskIo<DecodingIo>>({valid, plane}, io).run();
  return valid;
}

std::vector<uint8_t> decodeValidity(std::span<const uint8_t> codeword, Extent plane) {
  std::vector<uint8_t> valid(plane.samples());
  DecodingIo io(codeword);
  ValidityPass<DecodingIo>({valid, plane}, io).run();
  return valid;
}

}  // namespace tetrakis::inline lattice
