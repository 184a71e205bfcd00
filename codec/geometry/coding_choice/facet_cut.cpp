// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/coding_choice/facet_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/portable_math.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"

namespace tetrakis::inline coding_choice {

namespace {

/// Bytes of the corrections behind a cut that leaves the error `rmse`, in steps.
double correctionBytes(const HeightSteps& steps, double samples, const FacetShare& facets,
                       double rmse) {
  constexpr double kNear = 0.7;    // bits of a sample on a facet
  constexpr double kSpread = 2.1;  // those of normal errors beyond log2 of their deviation
  const double spacings = std::max(rmse * steps.step / facets.spacing, 1.);
  const double beyond = portable::log2(spacings) + kSpread;
  return samples * (facets.beyond * beyond + (1 - facets.beyond) * kNear) / 8;
}

}  // namespace

double chooseFacetCut(const HeightSteps& steps, Extent extent, const FacetShare& facets,
                      double room) {
  constexpr double kFinest = 2, kHalfOctave = 0.5;
  constexpr double kForPrefixes = 1.1, kWithRoom = 1.25;
  const PlaneView<const int32_t> plane = steps.lifting(extent);
  const TypicalPlane lossy(plane, steps.range_bits, Purpose::kLossy);
  const auto samples = static_cast<double>(markedIn(extent, plane.valid));
  double least = std::numeric_limits<double>::infinity(), finest = 0;
  for (double log2 = steps.range_bits; log2 >= kFinest; log2 -= kHalfOctave) {
    const PlaneCost cost = lossy.cost(portable::exp2(log2));
    const double squares = cost.squares / samples;
    const double bytes =
        cost.bits / 8 + correctionBytes(steps, samples, facets, std::sqrt(squares));
    if (bytes > std::max(kForPrefixes * least, std::min(kWithRoom * least, room))) break;
    least = std::min(least, bytes);
    finest = squares;
  }
  return finest;
}

}  // namespace tetrakis::inline coding_choice
