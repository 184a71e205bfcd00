// SPDX-License-Identifier: Apache-2.0
// The functions here make procedural noise for the sample terrain. They use only + - * / sqrt floor
// of doubles and integer hashes, so that the bits are the same everywhere (mathematical library
// functions differ in the last place). Gradient noise: Perlin, "Improving noise", SIGGRAPH 2002.
// Ridged multifractal: Musgrave, in "Texturing and modeling: a procedural approach", 2003.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tetrakis::tools::synth {

/// Position on the ground in samples, x to the east, y to the south.
struct Point {
  double x = 0, y = 0;
};

/// Avalanche hash of three words (finaliser of SplitMix64).
inline uint64_t hash(uint64_t seed, int64_t x, int64_t y) {
  uint64_t h = seed + 0x9e3779b97f4a7c15u * static_cast<uint64_t>(x) +
               0xd1b54a32d192ed03u * static_cast<uint64_t>(y);
  h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9u;
  h = (h ^ h >> 27) * 0x94d049bb133111ebu;
  return h ^ h >> 31;
}

/// A quicker hash whose upper bits are good enough for noise.
inline uint64_t latticeHash(uint64_t seed, int64_t x, int64_t y) {
  uint64_t h = (seed ^ static_cast<uint64_t>(x) * 0x9e3779b97f4a7c15u) +
               static_cast<uint64_t>(y) * 0xd1b54a32d192ed03u;
  h = (h ^ h >> 32) * 0xbf58476d1ce4e5b9u;
  return (h ^ h >> 29) * 0x94d049bb133111ebu;
}

/// Uniform in [0, 1).
inline double unitHash(uint64_t seed, int64_t x, int64_t y) {
  return static_cast<double>(hash(seed, x, y) >> 11) * 0x1p-53;
}

inline double clamp01(double v) {
  return std::clamp(v, 0.0, 1.0);
}

/// 0 below `low`, 1 above `high`, smooth between.
inline double smoothStep(double low, double high, double v) {
  const double t = clamp01((v - low) / (high - low));
  return t * t * (3 - 2 * t);
}

inline double mix(double a, double b, double t) {
  return a + (b - a) * t;
}

/// Dot product of (x, y) with one of eight directions of equal weight: a table, as branches on
/// noise are never predicted.
inline double gradientDot(uint64_t h, double x, double y) {
  constexpr double kD = 0.7071067811865476;
  constexpr Point kDirections[8] = {{1, 0},   {-1, 0},   {0, 1},    {0, -1},
                                    {kD, kD}, {kD, -kD}, {-kD, kD}, {-kD, -kD}};
  const Point& direction = kDirections[h >> 61];
  return direction.x * x + direction.y * y;
}

/// Floor of what an int64_t holds, as fast without SSE 4.1 as with it.
inline int64_t floorOf(double v) {
  const int64_t whole = static_cast<int64_t>(v);
  return whole - (static_cast<double>(whole) > v);
}

/// Gradient noise, within -1 and 1, zero mean, features about one unit wide.
inline double noise(uint64_t seed, Point p) {
  const int64_t ix = floorOf(p.x), iy = floorOf(p.y);
  const double x = p.x - static_cast<double>(ix), y = p.y - static_cast<double>(iy);
  const auto fade = [](double t) { return t * t * t * (t * (6 * t - 15) + 10); };
  const double u = fade(x), v = fade(y);
  const auto corner = [&](int dx, int dy) {
    return gradientDot(latticeHash(seed, ix + dx, iy + dy), x - dx, y - dy);
  };
  const double top = mix(corner(0, 0), corner(1, 0), u);
  const double bottom = mix(corner(0, 1), corner(1, 1), u);
  return 1.4 * mix(top, bottom, v);
}

/// Sum of octaves, each of twice the frequency and half the amplitude: within -1 and 1. The turn
/// between octaves (3-4-5 triangle) hides the lattice. Ends where enough(sum, rest) says that the
/// octaves left, which add up to less than `rest`, do not matter.
template <class Enough>
double fractalUntil(uint64_t seed, Point p, int octaves, Enough enough) {
  double sum = 0, amplitude = 0.5;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude * noise(seed + static_cast<uint64_t>(i), p);
    if (enough(sum, amplitude)) break;
    p = {2 * (0.8 * p.x - 0.6 * p.y), 2 * (0.6 * p.x + 0.8 * p.y)};
    amplitude /= 2;
  }
  return sum;
}

inline double fractal(uint64_t seed, Point p, int octaves) {
  return fractalUntil(seed, p, octaves, [](double, double) { return false; });
}

/// Ridged multifractal in about 0 to 1: folded noise, detail only where the coarser octaves are
/// high.
inline double ridged(uint64_t seed, Point p, int octaves) {
  double sum = 0, amplitude = 0.55, weight = 1;
  for (int i = 0; i < octaves; ++i) {
    double n = 1 - std::abs(noise(seed + static_cast<uint64_t>(i), p));
    n *= n * weight;
    weight = clamp01(1.6 * n);
    sum += amplitude * n;
    p = {2 * (0.8 * p.x - 0.6 * p.y), 2 * (0.6 * p.x + 0.8 * p.y)};
    amplitude /= 2;
  }
  return sum;
}

/// Moves a point by fractal noise of the given reach: straight features become natural ones.
inline Point warp(uint64_t seed, Point p, double reach, int octaves) {
  return {p.x + reach * fractal(seed, p, octaves),
          p.y + reach * fractal(seed + 100, {p.x + 5.2, p.y + 1.3}, octaves)};
}

}  // namespace tetrakis::tools::synth
