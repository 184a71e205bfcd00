// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/values/value_table.hpp"

#include <cassert>
#include <cmath>

#include "base/samples.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"

namespace tetrakis::inline values {

namespace {

template <class T>
DrawnValue drawn(uint32_t word, const GeometryHeader& header) {
  constexpr double kMost = 1 << 25;
  const auto value = static_cast<double>(fromOrder<T>(word));
  const double steps = (value - header.base) / header.step;
  DrawnValue out{0, 0};
  if (!std::isnan(steps)) {
    const double scaled = std::ldexp(std::clamp(steps, -kMost, kMost), DrawnValue::kFractionBits);
    out.height = static_cast<int32_t>(std::round(scaled));
  }
  const int32_t whole = wholeStep(out.height, DrawnValue::kFractionBits);
  const T near = restore<T>(header.base, header.step, whole);
  out.correction = static_cast<int32_t>(word - orderOf(near));
  return out;
}

}  // namespace

std::vector<DrawnValue> drawnValues(const ValueTable& table, const GeometryHeader& header) {
  assert(!table.empty());
  std::vector<DrawnValue> values;
  values.reserve(table.words.size());
  withSampleType(static_cast<tks_sample>(header.sample), [&](auto type) {
    for (const uint32_t word : table.words) values.push_back(drawn<decltype(type)>(word, header));
  });
  return values;
}

void applyTable(const ValueTable& table, const GeometryHeader& header, DecodedHeights& decoded) {
  const std::vector<DrawnValue> values = drawnValues(table, header);
  DecodedGeometry& geometry = decoded.geometry;
  decoded.corrections.resize(geometry.heights.size());
  for (size_t i = 0; i < geometry.heights.size(); ++i) {
    const int32_t q = wholeStep(geometry.heights[i], geometry.fraction_bits);
    const DrawnValue& value = values[table.placeOf(q)];
    geometry.heights[i] = value.height;
    decoded.corrections[i] = value.correction;
  }
  for (size_t i = 0; i < geometry.valid.size(); ++i) {
    if (geometry.valid[i]) continue;
    geometry.heights[i] = 0;
    decoded.corrections[i] = 0;
  }
  geometry.fraction_bits = DrawnValue::kFractionBits;
  geometry.quiet_levels = 0;
}

}  // namespace tetrakis::inline values
