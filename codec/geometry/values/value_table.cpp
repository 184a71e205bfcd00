// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/values/value_table.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/samples.hpp"
#include "bitstream/coder/range_decoder.hpp"
#include "bitstream/coder/value_table_pass.hpp"
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

ValueTable decodeValueTable(std::span<const uint8_t> codeword, uint32_t values) {
  ValueTable table{std::vector<uint32_t>(values)};
  DecisionDecoding io(codeword);
  ValueTablePass<DecisionDecoding<>>(io, kValueBits).run(table.words);
  if (io.stopped()) return {};
  return table;
}

/// The rise of the polyline at a place. place: in units of 2^-fraction_bits.
int64_t StandIn::riseAt(int64_t place, int fraction_bits) const {
  const auto after = std::upper_bound(
      knots_.begin(), knots_.end(), place,
      [&](int64_t at, const TableKnot& k) { return at < int64_t{k.place} << fraction_bits; });
  if (after == knots_.begin()) return knots_.front().rise;
  if (after == knots_.end()) return knots_.back().rise;
  const TableKnot &a = *(after - 1), &b = *after;
  const int64_t run = int64_t{b.place - a.place} << fraction_bits;
  const int64_t part = (b.rise - a.rise) * (place - (int64_t{a.place} << fraction_bits));
  const int64_t down = part < 0 && part % run != 0 ? 1 : 0;
  return a.rise + part / run - down;
}

int32_t StandIn::heightOf(int32_t v, int fraction_bits) const {
  constexpr int64_t kMost = int64_t{1} << 29;
  assert(!knots_.empty());
  const int64_t line = (int64_t{v} << kFractionBits) >> fraction_bits;
  const int64_t place = v + (middle_ << fraction_bits);
  return static_cast<int32_t>(std::clamp(line, -kMost, kMost) + riseAt(place, fraction_bits));
}

DecodedGeometry heightsOfStandIn(const GeometryLayers& layers, DecodedGeometry places) {
  if (layers.table_knots.empty()) return places;
  const StandIn stand_in(layers.table_knots, layers.table_values);
  DecodedGeometry geometry = std::move(places);
  for (int32_t& height : geometry.heights)
    height = stand_in.heightOf(height, geometry.fraction_bits);
  for (size_t i = 0; i < geometry.valid.size(); ++i) {
    if (!geometry.valid[i]) geometry.heights[i] = 0;
  }
  geometry.fraction_bits = StandIn::kFractionBits;
  geometry.quiet_levels = 0;
  return geometry;
}

}  // namespace tetrakis::inline values
