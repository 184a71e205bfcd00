// SPDX-License-Identifier: Apache-2.0
// Belts across the terrain, bent by noise.
#include "apps/tools/synth/layout.hpp"

namespace tetrakis::tools::synth {
namespace {

constexpr double kBeltBend = 0.2;  // of belts by noise
constexpr int kOctaves = 9;

}  // namespace

// With t = tan(angle / 2), (2 t, 1 - t^2) / (1 + t^2) is the unit vector at that angle from the
// north.
Layout::Layout(uint64_t seed) : seed_(hash(seed, 1, 0)) {
  const double t = 0.8 * (unitHash(seed_, 2, 0) - 0.5);
  inland_direction_ = {2 * t / (1 + t * t), -(1 - t * t) / (1 + t * t)};
}

double Layout::belt(Point p) const {
  const Point d = inland_direction_;
  const double reach = std::abs(d.x) + std::abs(d.y);  // of the square along d
  return 0.5 + ((p.x - 0.5) * d.x + (p.y - 0.5) * d.y) / reach;
}

double Layout::inland(Point p) const {
  return belt(p) + kBeltBend * fractal(seed_ + 10, {3 * p.x, 3 * p.y}, kOctaves);
}

bool Layout::isSea(Point p) const {
  constexpr double kRounding = 1e-9;
  const double straight = belt(p);
  const auto decided = [&](double sum, double rest) {
    return std::abs(straight + kBeltBend * sum - kCoast) > kBeltBend * rest + kRounding;
  };
  return straight + kBeltBend * fractalUntil(seed_ + 10, {3 * p.x, 3 * p.y}, kOctaves, decided) <
         kCoast;
}

double Layout::uplift(Point p) const {
  const double s = inland(p);
  const Point bent = warp(seed_ + 20, {4 * p.x, 4 * p.y}, 0.5, 4);
  const double mountains =
      smoothStep(kFoot, kRange, s) * (0.35 + 0.75 * ridged(seed_ + 30, bent, 5));
  const double hills = 0.28 * smoothStep(0.18, 0.55, fractal(seed_ + 40, {5 * p.x, 5 * p.y}, 4)) *
                       smoothStep(kCoast, kCoast + 0.1, s);
  return 0.05 + mountains + hills;
}

Point Layout::lake() const {
  const Point d = inland_direction_;
  const double reach = std::abs(d.x) + std::abs(d.y);
  const double along = (kFoot + 0.03 - 0.5) * reach;
  const double across = 0.4 * (unitHash(seed_, 3, 0) - 0.5);
  return {0.5 + along * d.x - across * d.y, 0.5 + along * d.y + across * d.x};
}

}  // namespace tetrakis::tools::synth
