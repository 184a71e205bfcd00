// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/flat/flat_areas.hpp"

#include <cassert>
#include <limits>
#include <utility>
#include <vector>

#include "bitstream/coder/range_decoder.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/flat/flat_pass.hpp"

namespace tetrakis::inline flat {

namespace {

/// Calls visit(sample, label, above) for marked samples, row by row. The label is that of the
/// sample before, else that of the sample above, else the next new one; so labels rise with their
/// first samples, and only one row of them is known at a time. above: the label of the sample
/// above, or the sample's own where that is not marked. Returns how many labels there are.
template <class Visit>
uint32_t forEachLabel(const PlaneView<const uint8_t>& flat, const Visit& visit) {
  constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  std::vector<uint32_t> row(flat.width, kNone);
  uint32_t labels = 0, sample = 0;
  for (uint32_t y = 0; y < flat.height; ++y) {
    uint32_t before = kNone;
    for (uint32_t& above : row) {
      uint32_t label = kNone;
      if (flat.data[sample] != 0) {
        label = before != kNone ? before : above != kNone ? above : labels++;
        visit(sample, label, above != kNone ? above : label);
      }
      before = above = label;
      ++sample;
    }
  }
  return labels;
}

}  // namespace

/// Labels are joined where they touch, and the first of the joined labels stands for an area. The
/// plane is visited three times, so that labels need not be kept for all samples.
NumberedAreas numberAreas(const PlaneView<const uint8_t>& flat) {
  assert(flat.extent().samples() <= GeometryLayers::kMostFlatSamples);
  JoinedLabels joined(forEachLabel(flat, [](uint32_t, uint32_t, uint32_t) {}));
  forEachLabel(flat, [&](uint32_t, uint32_t label, uint32_t above) { joined.join(label, above); });
  NumberedAreas areas;
  std::vector<uint32_t> numbers = std::move(joined).earlier();
  for (uint32_t label = 0; label < numbers.size(); ++label) {
    const bool first = numbers[label] == label;
    if (first && areas.count++ == GeometryLayers::kMostFlatAreas) return {};
    numbers[label] = first ? areas.count : numbers[numbers[label]];
  }
  areas.numbers.resize(flat.extent().samples());
  forEachLabel(flat, [&](uint32_t sample, uint32_t label, uint32_t) {
    areas.numbers[sample] = static_cast<uint16_t>(numbers[label]);
  });
  return areas;
}

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
