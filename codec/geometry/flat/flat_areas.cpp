// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/flat/flat_areas.hpp"

#include <cassert>

#include "bitstream/stream/geometry_header.hpp"

namespace tetrakis::inline flat {

NumberedAreas numberAreas(const PlaneView<const uint8_t>& flat) {
  assert(flat.extent().samples() <= GeometryLayers::kMostFlatSamples);
  const uint8_t* const marks = flat.data;
  const std::vector<uint32_t> first = firstSamples(
      flat.extent(), [&](uint32_t i, uint32_t j) { return (marks[i] & marks[j]) != 0; });
  NumberedAreas areas{std::vector<uint16_t>(first.size())};
  for (uint32_t i = 0; i < first.size(); ++i) {
    if (marks[i] == 0) continue;
    if (first[i] == i && areas.count++ == GeometryLayers::kMostFlatAreas) return {};
    areas.numbers[i] = first[i] == i ? static_cast<uint16_t>(areas.count) : areas.numbers[first[i]];
  }
  return areas;
}

}  // namespace tetrakis::inline flat
