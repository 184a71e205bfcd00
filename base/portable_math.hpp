// SPDX-License-Identifier: Apache-2.0
// The namespace portable holds logarithms, powers and angles with the same bits on every machine,
// because encoders make choices by them. The functions of C libraries differ in their last bit,
// from one processor to the next even in one library.
#pragma once

namespace tetrakis::inline base {

/// Named as in <cmath>, and rounded to the nearest double but once in some thousands of times.
namespace portable {

double log(double x);
double log2(double x);
double log10(double x);
double exp(double x);
double exp2(double x);

/// `x` >= 0.
double pow(double x, double y);

/// |x| < pi / 2.
double tan(double x);

/// |x| < pi.
double sin(double x);
double cos(double x);

/// `x` is finite.
double atan(double x);

}  // namespace portable

}  // namespace tetrakis::inline base
