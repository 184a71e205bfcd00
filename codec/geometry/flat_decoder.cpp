// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/flat_decoder.hpp"

#include <utility>
#include <vector>

#include "bitstream/coder/range_decoder.hpp"
#include "codec/geometry/flat_pass.hpp"

namespace tetrakis::inline geometry {

namespace {

class FlatDecoding {
 public:
  explicit FlatDecoding(std::span<const uint8_t> codeword) : decoder_(codeword) {}
  bool decide(AdaptiveBit& model, bool) { return decoder_.decode(model); }
  bool even(bool) { return decoder_.decodeEven(); }
  bool stopped() const { return decoder_.exhausted(); }

 private:
  RangeDecoder decoder_;
};

}  // namespace

FlatAreas decodeFlatAreas(std::span<const uint8_t> codeword, Extent plane, Mask valid,
                          uint32_t areas) {
  FlatDecoding io(codeword);
  NumberedAreas numbered;
  {
    std::vector<uint8_t> flat(plane.samples());
    FlatMaskIo<FlatDecoding> mask_io(io, valid, nullptr);
    ValidityPass<FlatMaskIo<FlatDecoding>>({flat, plane}, mask_io).run();
    if (!io.stopped()) numbered = numberAreas(PlaneView<const uint8_t>(flat, plane));
  }
  if (numbered.count != areas) return {};
  FlatAreas out{std::move(numbered.numbers), std::vector<int32_t>(areas)};
  FlatLevelsPass<FlatDecoding>(io).run(out.levels);
  if (io.stopped()) return {};
  return out;
}

}  // namespace tetrakis::inline geometry
