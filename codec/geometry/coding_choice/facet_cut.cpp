// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/coding_choice/facet_cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/portable_math.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"

namespace tetrakis::inline coding_choice {

namespace {

/// Bits of a sample on a facet. A larger number makes the bytes of cuts more alike, so that finer
/// cuts are taken.
constexpr double kNear = 0.7;
/// Bits of normal errors beyond log2 of their deviation; their entropy is 2.05. A larger number
/// makes the bytes of cuts more alike as well.
constexpr double kSpread = 2.1;
/// log2 of the finest step that is tried, and the distance of steps. A finer end and smaller
/// distances find better cuts, and take time.
constexpr double kFinestLog2 = 2, kHalfOctave = 0.5;
/// The bytes that a finer cut may take over the shortest one: for the sake of prefixes, and where
/// there is room. A tenth more takes 3 to 8 % of the bytes, and leaves 0.6 of the RMSE at 40 %.
constexpr double kForPrefixes = 1.1, kWithRoom = 1.25;

/// Bytes of the corrections behind a cut that leaves the error `rmse`, in steps.
double correctionBytes(const HeightSteps& steps, double samples, const FacetShare& facets,
                       double rmse) {
  const double spacings = std::max(rmse * steps.step / facets.spacing, 1.);
  const double beyond = portable::log2(spacings) + kSpread;
  return samples * (facets.beyond * beyond + (1 - facets.beyond) * kNear) / 8;
}

}  // namespace

double chooseFacetCut(const HeightSteps& steps, Extent extent, const FacetShare& facets,
                      double room) {
  const PlaneView<const int32_t> plane = steps.lifting(extent);
  const TypicalPlane lossy(plane, steps.range_bits, Purpose::kLossy);
  const auto samples = static_cast<double>(markedIn(extent, plane.valid));
  double least = std::numeric_limits<double>::infinity(), finest = 0;
  for (double log2 = steps.range_bits; log2 >= kFinestLog2; log2 -= kHalfOctave) {
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
