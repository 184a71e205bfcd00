// SPDX-License-Identifier: Apache-2.0
#include "lattice/validity_decoder.hpp"

#include "bitstream/coder/range_decoder.hpp"
#include "lattice/validity_pass.hpp"

namespace tetrakis {

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

std::vector<uint8_t> decodeValidity(std::span<const uint8_t> codeword, uint32_t width,
                                    uint32_t height) {
  std::vector<uint8_t> valid(size_t{width} * height);
  DecodingIo io(codeword);
  ValidityPass<DecodingIo>(valid, width, height, io).run();
  return valid;
}

}  // namespace tetrakis
