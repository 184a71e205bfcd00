// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/values/value_stand_in.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace tetrakis::inline values {

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
