// SPDX-License-Identifier: Apache-2.0
// Angles to about eight digits, by polynomials of M. Abramowitz and I. Stegun, "Handbook of
// mathematical functions" (1964). They consist of sums and products alone, so that they have the
// same bits on every machine, and take a hundredth of the time of base/portable_math.hpp.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include "codec/remesh/ring_flattening.hpp"

namespace tetrakis::inline remesh {

/// The sum of terms[k] * x^k.
template <size_t kTerms>
double polynomial(const double (&terms)[kTerms], double x) {
  double sum = 0;
  for (size_t k = kTerms; k-- > 0;) sum = sum * x + terms[k];
  return sum;
}

/// The angle from the first axis to the direction (x, y), y >= 0, from 0 to pi (4.4.49); pi / 2
/// where both are 0.
inline double quickAngle(double x, double y) {
  constexpr double kAtan[] = {1,           -.3333314528, .1999355085,  -.1420889944, .1065626393,
                              -.075289640, .0429096138,  -.0161657367, .0028662257};
  const auto atan = [&](double t) { return t * polynomial(kAtan, t * t); };
  if (y > std::abs(x) || (x == 0 && y == 0))
    return std::numbers::pi / 2 - (y > 0 ? atan(x / y) : 0);
  return x > 0 ? atan(y / x) : std::numbers::pi + atan(y / x);
}

/// The point at a distance of 1 in the direction of an angle between -pi and pi (4.3.97, 4.3.99),
/// by the half of the angle.
inline FlatPoint quickDirection(double angle) {
  constexpr double kSine[] = {1, -.1666666664, .0083333315, -.000198409, .0000027526, -.0000000239};
  constexpr double kCosine[] = {1,           -.4999999963, .0416666418, -.0013888397,
                                .0000247609, -.0000002605};
  const double half = angle / 2, square = half * half;
  const double sine = half * polynomial(kSine, square), cosine = polynomial(kCosine, square);
  const double size = sine * sine + cosine * cosine;
  return {(cosine * cosine - sine * sine) / size, 2 * sine * cosine / size};
}

}  // namespace tetrakis::inline remesh
