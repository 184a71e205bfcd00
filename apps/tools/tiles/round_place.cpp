// SPDX-License-Identifier: Apache-2.0
#include "apps/tools/tiles/round_place.hpp"

#include <algorithm>
#include <cmath>

namespace tetrakis::tools {
namespace {

constexpr double kRound = 360;

}  // namespace

uint32_t columnsRound(const RasterPlace& place, uint32_t width, uint32_t height) {
  constexpr double kNear = 0.01;  // of a column
  uint32_t columns = 0;
  for (const double row : {0.0, height / 2.0, double(height)}) {
    const double first = place.earthAt(0, row)[0], last = place.earthAt(width, row)[0];
    const double middle = place.earthAt(width / 2.0, row)[0];
    const double degrees = std::abs(last - first), near = kNear * degrees / width;
    uint32_t here = 0;
    if (std::abs(degrees - kRound) < near) here = width;
    if (width > 1 && std::abs(degrees * (width - 1.0) / width - kRound) < near) here = width - 1;
    if (here == 0 || !(std::abs(middle - (first + last) / 2) < near)) return 0;
    if (columns > 0 && here != columns) return 0;
    columns = here;
  }
  return columns;
}

SamplesBeside samplesBeside(double at, uint32_t count) {
  at = std::isfinite(at) ? std::clamp(at, 0.0, count - 1.0) : 0;
  const auto first = static_cast<uint32_t>(at);
  return {first, std::min(first + 1, count - 1), at - first};
}

SamplesBeside samplesRound(double at, uint32_t count, double period) {
  at -= std::floor(at / period) * period;
  // Of a mip level the last sample may lie less than a step before the first.
  const auto last = static_cast<uint32_t>(std::min(std::ceil(period), double(count))) - 1;
  const uint32_t first = std::min(static_cast<uint32_t>(at), last);
  if (first < last) return {first, first + 1, at - first};
  return {last, 0, std::min((at - last) / (period - last), 1.0)};
}

}  // namespace tetrakis::tools
