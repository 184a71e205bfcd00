// SPDX-License-Identifier: Apache-2.0
// The knot: a tube around the trefoil that winds about a torus, with bumps.
#include <algorithm>
#include <numbers>

#include "apps/tools/synth/surfaces/shape.hpp"
#include "apps/tools/synth/surfaces/solid_noise.hpp"
#include "base/portable_math.hpp"

namespace tetrakis::tools::synth {
namespace {

constexpr double kRing = 0.65, kPipe = 0.3, kTube = 0.13;  // radii

/// Of an angle in turns.
struct Turn {
  double cosine, sine;
  explicit Turn(double turns) {
    const double rest = turns - std::floor(turns + 0.5);  // within -1/2 and 1/2
    constexpr double kQuarter = 0.25;
    const bool far = rest > kQuarter || rest < -kQuarter;
    const double near = !far ? rest : rest > 0 ? 0.5 - rest : -0.5 - rest;
    sine = portable::sin(2 * std::numbers::pi * near);
    cosine = (far ? -1 : 1) * portable::cos(2 * std::numbers::pi * near);
  }
};

/// The middle of the tube, and the directions around it.
struct Middle {
  Spot place, out, across;
};

Middle middleAt(double t) {
  constexpr int kAround = 2, kThrough = 3;
  const Turn a(kAround * t), b(kThrough * t);
  const double radius = kRing + kPipe * b.cosine;
  const Spot outward{b.cosine * a.cosine, b.cosine * a.sine, b.sine};
  const Spot along{-kThrough * kPipe * b.sine * a.cosine - kAround * radius * a.sine,
                   -kThrough * kPipe * b.sine * a.sine + kAround * radius * a.cosine,
                   kThrough * kPipe * b.cosine};
  return {{radius * a.cosine, radius * a.sine, kPipe * b.sine},
          outward,
          directionOf(cross(along, outward))};
}

}  // namespace

TriangleMesh knot(uint32_t triangles, uint64_t seed) {
  constexpr double kLongerThanWide = 12, kBumps = 0.35, kWidth = 4;
  constexpr int kOctaves = 3;
  const double fitting = std::sqrt(triangles / (2 * kLongerThanWide));
  const auto around = std::max(3U, static_cast<uint32_t>(fitting + 0.5));
  const auto along = std::max(24U, triangles / (2 * around));
  TriangleMesh shape;
  for (uint32_t i = 0; i < along; ++i) {
    const Middle middle = middleAt(double{1} * i / along);
    for (uint32_t j = 0; j < around; ++j) {
      const Turn turn(double{1} * j / around);
      const Spot side = turn.cosine * middle.out + turn.sine * middle.across;
      const Spot point = middle.place + kTube * side;
      const double bump = kBumps * solidFractal(seed, kWidth * point, kOctaves);
      shape.points.push_back(middle.place + kTube * (1 + bump) * side);
    }
  }
  for (uint32_t i = 0; i < along; ++i) {
    for (uint32_t j = 0; j < around; ++j) {
      const uint32_t next = (i + 1) % along, up = (j + 1) % around;
      const uint32_t a = i * around + j, b = next * around + j;
      const uint32_t c = next * around + up, d = i * around + up;
      shape.triangles.push_back({a, c, b});
      shape.triangles.push_back({a, d, c});
    }
  }
  return shape;
}

}  // namespace tetrakis::tools::synth
