// SPDX-License-Identifier: Apache-2.0
#include "codec/cube/cube_interpolation.hpp"

#include <algorithm>
#include <cmath>

namespace tetrakis::inline cube {

namespace {

/// A place along a side of n as the sample before it, below n.
uint32_t sampleBefore(double along, uint32_t n) {
  return std::min(static_cast<uint32_t>(along), n - 1);
}

}  // namespace

std::array<float, kTaps> cubicWeights(float part) {
  const float t = part, square = t * t, cube = square * t;
  return {0.5f * (2 * square - t - cube), 0.5f * (2 - 5 * square + 3 * cube),
          0.5f * (t + 4 * square - 3 * cube), 0.5f * (cube - square)};
}

/// A sample at the angles (a, b) of a patch, from its middle, is at the angle atan(tan(b) / tan(a))
/// of the patch beside it.
CubeInterpolation::CubeInterpolation(const Forest& cube)
    : cube_(&cube), n_(cube.side() - 1), beyond_(cube.side()) {
  const double beyond = offMiddle(1 + 1.0 / n_);
  for (uint32_t i = 0; i <= n_; ++i)
    beyond_[i] = placeAt(offMiddle(static_cast<double>(i) / n_) / beyond) * n_;
}

CubeCell CubeInterpolation::cellAt(const CubePlace& place) const {
  const double x = place.x * n_, y = place.y * n_;
  const uint32_t column = sampleBefore(x, n_), row = sampleBefore(y, n_);
  return {place.patch, column, row, static_cast<float>(x - column), static_cast<float>(y - row)};
}

CubeTaps CubeInterpolation::taps(const CubeCell& cell) const {
  constexpr int64_t kBefore = kTaps / 2 - 1;
  const auto across = cubicWeights(cell.part_x), down = cubicWeights(cell.part_y);
  const bool inside = isInside(cell);
  CubeTaps taps;
  for (uint32_t i = 0; i < kTaps * kTaps; ++i) {
    const uint32_t x = i % kTaps, y = i / kTaps;
    const float weight = across[x] * down[y];
    const Forest::Place sample{cell.patch, cell.x + x - kBefore, cell.y + y - kBefore};
    if (inside)
      taps.add(numberOf(sample), weight);
    else
      addBeyond(taps, sample, weight);
  }
  return taps;
}

void CubeInterpolation::addInside(CubeTaps& taps, const Forest::Place& sample, float weight) const {
  taps.add(numberOf(cube_->owner(n_, sample)), weight);
}

/// A sample of the patch, or one beyond a side of it. What is beyond two sides is nowhere: it
/// weighs next to nothing, and what is beyond one of them does for it.
void CubeInterpolation::addBeyond(CubeTaps& taps, Forest::Place sample, float weight) const {
  const int64_t n = n_;
  const bool beside = sample.x < 0 || sample.x > n;
  if (beside) sample.y = std::clamp<int64_t>(sample.y, 0, n);
  if (!beside && sample.y >= 0 && sample.y <= n) return addInside(taps, sample, weight);
  const uint32_t side = beside ? (sample.x < 0 ? 3 : 1) : (sample.y < 0 ? 0 : 2);
  const uint32_t other = cube_->sides()[sample.patch * Forest::kSides + side];
  Forest::Place place = cube_->locate(n, sample);
  int64_t& along = other % 2 == 0 ? place.x : place.y;
  const double at = beyond_[static_cast<size_t>(along)];
  along = sampleBefore(at, n_);
  const auto part = static_cast<float>(at - static_cast<double>(along));
  addInside(taps, place, weight * (1 - part));
  ++along;
  addInside(taps, place, weight * part);
}

}  // namespace tetrakis::inline cube
