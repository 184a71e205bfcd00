// SPDX-License-Identifier: Apache-2.0
#include "encoder/heights/ways/exact_heights.hpp"

#include <cassert>

#include "codec/geometry/coding_choice/exact_cut.hpp"
#include "codec/geometry/drawn_heights/drawn_heights_estimate.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"
#include "encoder/heights/heights_notes.hpp"
#include "encoder/heights/quantised_heights.hpp"
#include "encoder/heights/ways/facet_heights.hpp"
#include "encoder/heights/ways/lossless_heights.hpp"

namespace tetrakis::inline ways {

namespace {

/// Exact heights are tried up to this many times the bytes, by an estimate. 14 DEMs take 0.88 to
/// 1.15 of the estimate: a larger factor takes time, a smaller one misses shorter heights.
constexpr double kClearlyMore = 1.4;
/// Estimates up to this many times as large again are tried by a cut: squares of distances take a
/// quarter by a cut. A larger factor takes the time of choosing more cuts.
constexpr double kMostByCut = 4;
/// Errors, in steps, up to which exact heights are tried for a largest error. A larger number takes
/// time for coarse bounds, within which rounded heights mostly are shorter.
constexpr double kMostSteps = 2;

}  // namespace

bool mayTakeNoMore(const EncodeInputs& inputs, const QuantisedHeights& heights, uint64_t bytes) {
  const HeightSteps& steps = heights.steps;
  const PlaneView<const int32_t> plane = steps.lifting(extentOf(*heights.samples));
  const double whole = typicalCost(plane, steps.range_bits, 0).bits / 8;
  const double most = kClearlyMore * static_cast<double>(bytes);
  if (whole <= most) return true;
  if (whole <= kMostByCut * most && steps.table.empty()) {
    const auto cut = chooseExactCut(plane, steps.range_bits, static_cast<uint64_t>(whole));
    if (cut && cut->bytes <= most) return true;
  }
  noteExpected(inputs, planOf(heights, Coding::kWavelet), whole);
  return false;
}

std::shared_ptr<const CodedHeights> exactHeightsFor(const EncodeInputs& inputs, double error,
                                                    uint64_t lossy_bytes) {
  assert(inputs.heights != nullptr && inputs.options.lossless == 0);
  tks_encode_options options = inputs.options;
  options.bytes = 0;
  options.psnr = options.max_error = 0;
  options.lossless = 1;
  const EncodeInputs lossless = inputs.with(options, inputs.priorities);
  const Result<std::shared_ptr<const QuantisedHeights>> heights = quantiseHeights(lossless);
  if (!heights.ok()) return nullptr;
  const HeightSteps& steps = (*heights)->steps;
  const PlaneView<const int32_t> plane(steps.steps, extentOf(*inputs.heights), steps.valid);
  const bool few = !steps.table.empty() || drawingMayFit(plane, lossy_bytes);
  if (few) return codeLosslessHeights(lossless, *heights);
  if (error < relativeStepOf(**heights)) return codeLosslessHeights(lossless, *heights);
  if (const auto facets = facetsOf(**heights); facets && mayFit(*facets, **heights, lossy_bytes))
    return codeLosslessHeights(lossless, *heights);
  if (error > kMostSteps * steps.step) return nullptr;
  if (!mayTakeNoMore(inputs, **heights, lossy_bytes)) return nullptr;
  return codeLosslessHeights(lossless, *heights);
}

}  // namespace tetrakis::inline ways
