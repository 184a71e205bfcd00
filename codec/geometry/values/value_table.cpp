// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/values/value_table.hpp"

#include <cassert>
#include <utility>

#include "base/samples.hpp"
#include "codec/geometry/steps/sample_order.hpp"

namespace tetrakis::inline values {

std::vector<ValueInSteps> valuesInSteps(const ValueTable& table, const GeometryHeader& header) {
  assert(!table.empty());
  const StepGrid grid(header.base, header.step);
  std::vector<ValueInSteps> values;
  values.reserve(table.words.size());
  withSampleType(static_cast<tks_sample>(header.sample), [&](auto type) {
    using T = decltype(type);
    for (const uint32_t word : table.words)
      values.push_back(inSteps(fromOrder<T>(word), header, grid, kTableFractionBits));
  });
  return values;
}

DecodedHeights heightsOf(const ValueTable& table, const GeometryHeader& header,
                         DecodedGeometry places) {
  const std::vector<ValueInSteps> values = valuesInSteps(table, header);
  DecodedHeights decoded{std::move(places), {}};
  DecodedGeometry& geometry = decoded.geometry;
  decoded.corrections.resize(geometry.heights.size());
  for (size_t i = 0; i < geometry.heights.size(); ++i) {
    const int32_t q = wholeStep(geometry.heights[i], geometry.fraction_bits);
    const ValueInSteps& value = values[table.placeOf(q)];
    geometry.heights[i] = value.height;
    decoded.corrections[i] = value.correction;
  }
  for (size_t i = 0; i < geometry.valid.size(); ++i) {
    if (geometry.valid[i]) continue;
    geometry.heights[i] = 0;
    decoded.corrections[i] = 0;
  }
  geometry.fraction_bits = kTableFractionBits;
  geometry.quiet_levels = 0;
  return decoded;
}

}  // namespace tetrakis::inline values
