// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/flat/flat_decoder.hpp"

#include <utility>
#include <vector>

#include "bitstream/coder/decision_decoding.hpp"
#include "codec/geometry/flat/flat_pass.hpp"

namespace tetrakis::inline flat {

namespace {

bool holdsAny(const BitPlane& flat) {
  for (uint32_t y = 0; y < flat.extent().height; ++y)
    if (flat.countBefore(flat.extent().width, y) > 0) return true;
  return false;
}

}  // namespace

FlatAreas decodeFlatAreas(std::span<const uint8_t> codeword, Extent plane, const SharedBits& valid,
                          uint32_t areas) {
  DecisionDecoding io(codeword);
  NumberedAreas numbered;
  {
    FlatMaskIo<DecisionDecoding<>> mask_io(io, valid.get(), nullptr);
    const BitPlane flat = ValidityPass<FlatMaskIo<DecisionDecoding<>>>(plane, mask_io).run();
    if (!io.stopped() && holdsAny(flat))
      numbered = numberAreas(PlaneView<const uint8_t>(flat.bytes(), plane));
  }
  if (numbered.count != areas) return {};
  FlatAreas out{std::move(numbered.numbers), std::vector<int32_t>(areas)};
  FlatHeightsPass<DecisionDecoding<>>(io).run(out.heights);
  if (io.stopped()) return {};
  return out;
}

}  // namespace tetrakis::inline flat
