// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "apps/tools/files/files.hpp"

namespace tetrakis::tools {

bool isSound(const GeoTransform& transform) {
  return std::all_of(transform.begin(), transform.end(),
                     [](double v) { return std::abs(v) < 0x1p512; });
}

GeoTransform movedTo(const GeoTransform& t, uint32_t column, uint32_t row) {
  GeoTransform moved = t;
  moved[0] += column * t[1] + row * t[2];
  moved[3] += column * t[4] + row * t[5];
  return moved;
}

}  // namespace tetrakis::tools
