// SPDX-License-Identifier: Apache-2.0
// Series in sums of two doubles, which have about 100 bits. They use only what IEEE 754 rounds in
// one way: + - * /. Sums and products with their errors: T. J. Dekker, "A floating-point technique
// for extending the available precision", 1971; D. E. Knuth, The Art of Computer Programming 2.
#include "base/portable_math.hpp"

#include <cmath>
#include <limits>

namespace tetrakis::inline base {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// high + low, where low is at most half a unit of high's last place.
struct Wide {
  double high = 0, low = 0;
};

/// |a| >= |b|.
Wide sumOfOrdered(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

Wide sumOf(double a, double b) {
  const double sum = a + b, b_in_sum = sum - a;
  return {sum, (a - (sum - b_in_sum)) + (b - b_in_sum)};
}

/// The upper 26 bits of a double and the lower ones.
Wide halvesOf(double a) {
  const double scaled = a * 0x8000001p0, high = scaled - (scaled - a);
  return {high, a - high};
}

Wide productOf(double a, double b) {
  const double product = a * b;
  const Wide x = halvesOf(a), y = halvesOf(b);
  const double rest = x.high * y.high - product + x.high * y.low + x.low * y.high;
  return {product, rest + x.low * y.low};
}

Wide operator+(const Wide& a, const Wide& b) {
  const Wide sum = sumOf(a.high, b.high);
  return sumOfOrdered(sum.high, sum.low + (a.low + b.low));
}

Wide operator-(const Wide& a, const Wide& b) {
  return a + Wide{-b.high, -b.low};
}

Wide operator*(const Wide& a, const Wide& b) {
  const Wide product = productOf(a.high, b.high);
  return sumOfOrdered(product.high, product.low + (a.high * b.low + a.low * b.high));
}

Wide operator/(const Wide& a, const Wide& b) {
  const double quotient = a.high / b.high;
  const Wide rest = a - b * Wide{quotient};
  return sumOfOrdered(quotient, rest.high / b.high);
}

/// `factor` is a power of two.
Wide scaled(const Wide& a, double factor) {
  return {a.high * factor, a.low * factor};
}

constexpr Wide kOne = {1};
constexpr Wide kThird = {0x1.5555555555555p-2, 0x1.5555555555555p-56};
constexpr Wide kLn2 = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
constexpr Wide kPerLn2 = {0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56};
constexpr Wide kPerLn10 = {0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};
constexpr Wide kHalfPi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/// ln x = exponent ln 2 + mantissa.
struct Logarithm {
  double exponent;
  Wide mantissa;
};

/// ln m = 2 artanh s, where s = (m - 1) / (m + 1) and artanh s = s + s^3 / 3 + s^5 / 5 + ...
Logarithm logarithmOf(double x) {
  constexpr double kSqrtHalf = 0.7071;
  constexpr double kSeries[] = {1. / 27, 1. / 25, 1. / 23, 1. / 21, 1. / 19, 1. / 17,
                                1. / 15, 1. / 13, 1. / 11, 1. / 9,  1. / 7,  1. / 5};
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < kSqrtHalf) {
    m *= 2;
    --exponent;
  }
  const Wide s = Wide{m - 1} / sumOf(m, 1), square = s * s;
  double rest = 0;
  for (const double coefficient : kSeries) rest = rest * square.high + coefficient;
  const Wide change = square * kThird + Wide{square.high * square.high * rest};
  return {static_cast<double>(exponent), scaled(s + s * change, 2)};
}

/// What has no logarithm, or no finite one.
bool isOrdinary(double x) {
  return x > 0 && x < kInfinity;
}

double logarithmOfOther(double x) {
  if (x == 0) return -kInfinity;
  return x > 0 ? x : std::numeric_limits<double>::quiet_NaN();
}

Wide wideLog(double x) {
  const Logarithm logarithm = logarithmOf(x);
  return kLn2 * Wide{logarithm.exponent} + logarithm.mantissa;
}

Wide wideLog2(double x) {
  const Logarithm logarithm = logarithmOf(x);
  return Wide{logarithm.exponent} + logarithm.mantissa * kPerLn2;
}

/// 2^exponent e^x, |x| <= 0.4: e^(x / 16) - 1 by its series, and ((1 + p)^2 - 1) = 2 p + p^2.
double powerOf(const Wide& x, double exponent) {
  constexpr double kSeries[] = {1. / 362880, 1. / 40320, 1. / 5040, 1. / 720,
                                1. / 120,    1. / 24,    1. / 6};
  const Wide part = scaled(x, 1. / 16);
  double rest = 0;
  for (const double coefficient : kSeries) rest = rest * part.high + coefficient;
  Wide p = part + (scaled(part * part, 0.5) + Wide{part.high * part.high * part.high * rest});
  for (int doubling = 0; doubling < 4; ++doubling) p = scaled(p, 2) + p * p;
  return std::ldexp((kOne + p).high, static_cast<int>(exponent));
}

/// 2^x.
double powerOfTwo(const Wide& x) {
  constexpr double kMost = 1100;
  if (!(x.high > -kMost)) return x.high <= -kMost ? 0 : x.high;
  if (x.high > kMost) return kInfinity;
  const double whole = std::floor(x.high + 0.5);
  return powerOf((x - Wide{whole}) * kLn2, whole);
}

/// The series of sine and cosine for a sixteenth of x, then tan 2a = 2 tan a / (1 - tan^2 a).
Wide wideTan(const Wide& x) {
  const Wide part = scaled(x, 1. / 16), square = part * part;
  Wide sine = kOne, cosine = kOne;
  for (int n = 20; n > 0; n -= 2) {
    cosine = kOne - square * cosine / Wide{static_cast<double>(n * (n - 1))};
    sine = kOne - square * sine / Wide{static_cast<double>(n * (n + 1))};
  }
  Wide tangent = part * sine / cosine;
  for (int doubling = 0; doubling < 4; ++doubling)
    tangent = scaled(tangent, 2) / (kOne - tangent * tangent);
  return tangent;
}

/// |x| <= 1, by steps of the rest: atan x = a + atan((x - tan a) / (1 + x tan a)).
Wide wideAtan(const Wide& x) {
  Wide angle = {x.high / (1 + 0.28 * x.high * x.high)};
  for (int step = 0; step < 2; ++step) {
    const Wide tangent = wideTan(angle), rest = (x - tangent) / (kOne + x * tangent);
    angle = angle + (rest - rest * rest * rest * kThird);
  }
  return angle;
}

}  // namespace

namespace portable {

double log(double x) {
  return isOrdinary(x) ? wideLog(x).high : logarithmOfOther(x);
}

double log2(double x) {
  return isOrdinary(x) ? wideLog2(x).high : logarithmOfOther(x);
}

double log10(double x) {
  return isOrdinary(x) ? (wideLog(x) * kPerLn10).high : logarithmOfOther(x);
}

double exp(double x) {
  constexpr double kMost = 800;
  if (!(x > -kMost)) return x <= -kMost ? 0 : x;
  if (x > kMost) return kInfinity;
  const double whole = std::floor(x * kPerLn2.high + 0.5);
  return powerOf(Wide{x} - kLn2 * Wide{whole}, whole);
}

double exp2(double x) {
  return powerOfTwo({x});
}

double pow(double x, double y) {
  if (y == 0) return 1;
  if (!isOrdinary(x)) return (x == 0) == (y > 0) ? 0 : kInfinity;
  return powerOfTwo(wideLog2(x) * Wide{y});
}

double tan(double x) {
  return wideTan({x}).high;
}

double sin(double x) {
  const Wide half = wideTan({x / 2});
  return (scaled(half, 2) / (kOne + half * half)).high;
}

double cos(double x) {
  const Wide half = wideTan({x / 2}), square = half * half;
  return ((kOne - square) / (kOne + square)).high;
}

double atan(double x) {
  if (!(std::abs(x) > 1)) return wideAtan({x}).high;
  const Wide rest = wideAtan(kOne / Wide{x});
  return (Wide{std::copysign(kHalfPi.high, x), std::copysign(kHalfPi.low, x)} - rest).high;
}

}  // namespace portable

}  // namespace tetrakis::inline base
