// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/values/value_table.hpp"

#include <cassert>
#include <cmath>
#include <utility>

#include "base/samples.hpp"
#include "codec/geometry/steps/restore.hpp"
#include "codec/geometry/steps/sample_order.hpp"

namespace tetrakis::inline values {

namespace {

template <class T>
ValueInSteps inSteps(uint32_t word, const GeometryHeader& header) {
  constexpr double kMost = 1 << 25;
  const auto value = static_cast<double>(fromOrder<T>(word));
  const double steps = (value - header.base) / header.step;
  ValueInSteps out{0, 0};
  if (!std::isnan(steps)) {
    const double scaled = std::ldexp(std::clamp(steps, -kMost, kMost), ValueInSteps::kFractionBits);
    out.height = static_cast<int32_t>(std::round(scaled));
  }
  const int32_t whole = wholeStep(out.height, ValueInSteps::kFractionBits);
  const T near = restore<T>(header.base, header.step, whole);
  out.correction = static_cast<int32_t>(word - orderOf(near));
  return out;
}

}  // namespace

std::vector<ValueInSteps> valuesInSteps(const ValueTable& table, const GeometryHeader& header) {
  assert(!table.empty());
  std::vector<ValueInSteps> values;
  values.reserve(table.words.size());
  withSampleType(static_cast<tks_sample>(header.sample), [&](auto type) {
    for (const uint32_t word : table.words) values.push_back(inSteps<decltype(type)>(word, header));
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
  geometry.fraction_bits = ValueInSteps::kFractionBits;
  geometry.quiet_levels = 0;
  return decoded;
}

}  // namespace tetrakis::inline values
