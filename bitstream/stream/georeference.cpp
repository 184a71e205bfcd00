// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/georeference.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tetrakis::inline stream {

namespace {

/// Compares bit for bit: -0 is not 0.
bool same(double a, double b) {
  return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b);
}

}  // namespace

GeoTransform northUp(double size_x, double size_y) {
  return {0, size_x, 0, 0, 0, -size_y};
}

GeoTransform stretched(const GeoTransform& t, double columns, double rows) {
  return {t[0], t[1] * columns, t[2] * rows, t[3], t[4] * columns, t[5] * rows};
}

TransformForm formOf(const GeoTransform& t, const TransformBasis& basis) {
  if (basis.has_heights && std::equal(t.begin(), t.end(), basis.heights.begin(), same))
    return TransformForm::kHeights;
  if (!same(t[2], 0) || !same(t[4], 0)) return TransformForm::kAny;
  if (same(t[1], basis.spacing[1]) && same(t[5], basis.spacing[5])) return TransformForm::kSpacing;
  return same(t[5], -t[1]) ? TransformForm::kSquare : TransformForm::kNorthUp;
}

bool isSound(const GeoTransform& transform) {
  return std::all_of(transform.begin(), transform.end(),
                     [](double v) { return std::abs(v) < 0x1p512; });
}

GeoTransform atLevel(const GeoTransform& t, int level) {
  if (level == 0) return t;
  const double size = std::ldexp(1.0, level), shift = (1 - size) / 2;
  GeoTransform level_transform = stretched(t, size, size);
  level_transform[0] += shift * (t[1] + t[2]);
  level_transform[3] += shift * (t[4] + t[5]);
  return level_transform;
}

}  // namespace tetrakis::inline stream
