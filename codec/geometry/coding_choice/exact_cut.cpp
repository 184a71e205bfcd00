// SPDX-License-Identifier: Apache-2.0
// chooseExactCut() and chooseFacetCut() find the cut of coefficients behind which corrections
// restore every sample, from its steps or as part of a facet.
#include "codec/geometry/coding_choice/cuts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "base/portable_math.hpp"
#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"

namespace tetrakis::inline coding_choice {

namespace {

/// The share of the bytes that a halving of the cut against all bytes costs early prefixes. A
/// larger share keeps prefixes of more streams, and misses shorter streams.
constexpr double kHalving = 0.05;
/// Estimates of coefficients err by up to this factor, alike for all steps. A larger factor takes
/// more of an error for one of the estimate, so that corrections are expected to take less.
constexpr double kEstimateOff = 1.15;
/// log2 of the step of the cut that is tried first, and of the last one: finer and coarser cuts are
/// tried while they save bytes. A first cut far from the best one takes time.
constexpr int kUsualLog2 = 2, kLastLog2 = 12;
/// No other cut is tried if the first one is worth less than the whole at this many times its
/// bytes. A larger factor takes time, and finds more cuts.
constexpr double kHopeless = 1.04;
/// Heights of fewer bits a sample are not cut: planes and plains lose more by a cut, which shows
/// where levels and surfaces end. A smaller number saves bytes of these heights.
constexpr double kLeastBits = 0.1;

/// Parts of a plane, one below the other, so that models which learn from one part serve the next.
struct StackedParts {
  Extent extent;
  std::vector<int32_t> steps, heights;
  std::vector<uint8_t> valid;
};

StackedParts stacked(const std::vector<TypicalPlane::Shown>& parts) {
  StackedParts all{{0, 0}, {}, {}, {}};
  for (const auto& part : parts) {
    all.extent.width = std::max(all.extent.width, part.samples.extent.width);
    all.extent.height += part.samples.extent.height;
  }
  all.steps.resize(all.extent.samples());
  all.heights.resize(all.extent.samples());
  all.valid.resize(all.extent.samples());
  size_t to = 0;
  for (const auto& part : parts) {
    const Mask valid = part.samples.valid;
    const auto [width, height] = part.samples.extent;
    for (uint32_t y = 0; y < height; ++y, to += all.extent.width) {
      for (uint32_t x = 0; x < width; ++x) {
        const size_t from = size_t{y} * width + x;
        all.steps[to + x] = part.samples.values[from];
        all.heights[to + x] = part.values[from];
        all.valid[to + x] = valid[from];
      }
    }
  }
  return all;
}

/// Cuts by the step of their coefficients, a power of two.
class TriedCuts {
 public:
  TriedCuts(const PlaneView<const int32_t>& heights, int range_bits, uint64_t whole_bytes)
      : lossy_(heights, range_bits, Purpose::kLossy),
        samples_(static_cast<double>(markedIn(heights.extent(), heights.valid))),
        whole_(typicalCost(heights, range_bits, 0).bits / 8) {
    // If the plane takes more bytes than estimates err by, it takes them outside its typical parts,
    // and corrections will be there as well.
    coefficients_ = static_cast<double>(whole_bytes) / whole_;
    corrections_ = coefficients_ / std::clamp(coefficients_, 1 / kEstimateOff, kEstimateOff);
  }

  const ExactCut& at(int log2) {
    const auto [known, is_new] = cuts_.try_emplace(log2);
    if (is_new) known->second = tried(portable::exp2(log2));
    return known->second;
  }

 private:
  ExactCut tried(double step) const {
    const PlaneCost cost = lossy_.cost(step);
    const std::vector<TypicalPlane::Shown> shown = lossy_.shown(step);
    const StackedParts parts = stacked(shown);
    const auto corrections = encodeExactSteps(
        parts.steps, {parts.heights, parts.extent, parts.valid}, shown.front().fraction_bits);
    const double cut = coefficients_ * cost.bits / 8;
    const double behind =
        corrections_ * lossy_.standsFor() * static_cast<double>(corrections.size());
    return {cost.squares / samples_, cut + behind, exactWorth(cut + behind, cut)};
  }

  TypicalPlane lossy_;
  double samples_, whole_;
  double coefficients_, corrections_;  ///< bytes of the plane for those of the parts
  std::map<int, ExactCut> cuts_;
};

}  // namespace

double exactWorth(double bytes, double cut) {
  return bytes * (1 + kHalving * portable::log2(std::max(bytes, 1.) / std::max(cut, 1.)));
}

bool isWorth(double worth, double whole_bytes) {
  return worth < (1 + kHalving) * whole_bytes;
}

std::optional<ExactCut> estimateExactCut(const PlaneView<const int32_t>& heights, int range_bits,
                                         uint64_t whole_bytes) {
  const auto bytes = static_cast<double>(whole_bytes);
  const auto samples = static_cast<double>(markedIn(heights.extent(), heights.valid));
  if (8 * bytes <= kLeastBits * samples) return {};
  TriedCuts cuts(heights, range_bits, whole_bytes);
  if (!isWorth(cuts.at(kUsualLog2).worth, kHopeless * bytes)) return cuts.at(kUsualLog2);
  int best = kUsualLog2;
  for (const int stride : {-1, 1}) {
    while (best + stride >= 0 && best + stride <= kLastLog2 &&
           cuts.at(best + stride).worth < cuts.at(best).worth)
      best += stride;
  }
  ExactCut cut = cuts.at(best);
  cut.pays = cut.bytes <= bytes && isWorth(cut.worth, bytes);
  return cut;
}

std::optional<ExactCut> chooseExactCut(const PlaneView<const int32_t>& heights, int range_bits,
                                       uint64_t whole_bytes) {
  const std::optional<ExactCut> cut = estimateExactCut(heights, range_bits, whole_bytes);
  return cut && cut->pays ? cut : std::nullopt;
}

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
