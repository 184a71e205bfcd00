// SPDX-License-Identifier: Apache-2.0
// Heights within a largest error e, in steps. Two ways, and the one of fewer bytes is kept:
//
//   round     heights become multiples of 2 e + 1 steps (floats of twice the bound) and are coded
//             to the last bit. Best where the error wanted is near the noise of the heights.
//   correct   the coefficients are cut, and what then is off by more than e gets a correction in
//             multiples of 2 e + 1. Best above: at 5 m on mountains half the bytes of rounding.
//
// Cutting so late that nothing is off by more than e takes up to twice the bytes of either.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "codec/geometry/bound_choice.hpp"
#include "codec/geometry/corrected_cut.hpp"
#include "codec/geometry/sample_order.hpp"
#include "codec/geometry/voids.hpp"
#include "encoder/encode_job.hpp"

namespace tetrakis {

namespace {

/// Squared error that the account states for that many bytes; linear between its points.
double distortionAt(const std::vector<RatePoint>& points, uint64_t bytes) {
  const auto after = std::find_if(points.begin(), points.end(),
                                  [&](const RatePoint& point) { return point.bytes > bytes; });
  if (after == points.begin() || after == points.end()) return points.back().distortion;
  const RatePoint &a = *(after - 1), &b = *after;
  const double t = static_cast<double>(bytes - a.bytes) / static_cast<double>(b.bytes - a.bytes);
  return a.distortion + t * (b.distortion - a.distortion);
}

}  // namespace

/// Exact steps leave an error of their own; what is left of the bound, in whole steps, the coding
/// may use. Where floats are then rounded beyond the bound one step less will do; none, the exact
/// steps, is always within.
void EncodeJob::boundHeights() {
  if (geometry_->layers.corrections == CorrectionKind::kSamples) {
    encodeGeometry(Purpose::kLossless);
    return;
  }
  geometry_->wavelet = waveletFor(geometryPurpose());
  const double bound = options_.max_error / std::abs(heights_->scale);
  const double room =
      (bound - errorsOf(*heights_, geometry_->steps).largest) / geometry_->steps.step;
  constexpr double kMost = 1 << 24;
  const auto largest = static_cast<int32_t>(std::clamp(room + 1e-9, 0.0, kMost));
  for (const int32_t tried : {largest, std::max(largest - 1, 0), 0}) {
    if (boundWithin(tried, bound - floatSpacing() / 2)) return;
  }
  encodeGeometry(Purpose::kLossless);
}

/// The way of fewest bytes that keeps the bound, into geometry_. False: none does. bound: in sample
/// units.
bool EncodeJob::boundWithin(int32_t largest, double bound) {
  const BoundWays ways =
      boundWays(geometry_->steps, {heights_->width, heights_->height}, geometry_->wavelet, largest);
  const EncodedHeights exact = *geometry_;
  std::optional<EncodedHeights> best;
  const auto consider = [&] {
    const uint64_t bytes = bytesOf(geometry_->tracks);
    if (withinBound() && (!best || bytes < bytesOf(best->tracks))) best = std::move(*geometry_);
    geometry_ = exact;
  };
  if (ways.round && widenSteps(bound)) consider();
  if (ways.round) {
    roundHeights(largest);
    consider();
  }
  const bool one_track = trackOptions(TrackId::kGeometry).region_log2 == 0;  // is cut, not many
  if (ways.correct && one_track) {
    correctHeights(largest, ways.mean_square);
    consider();
  }
  if (best) geometry_ = std::move(best);
  return best.has_value();
}

/// Between the largest floats; integers are exact.
double EncodeJob::floatSpacing() const {
  if (heights_->sample != TKS_F32) return 0;
  const SampleRange range = rangeOf(*heights_, geometry_->steps.valid);
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  return std::ldexp(1.0, spacingExponent(static_cast<float>(largest)));
}

bool EncodeJob::withinBound() const {
  const HeightErrors errors = heightErrors(bytesOf(geometry_->tracks));
  return errors.largest * std::abs(heights_->scale) <= options_.max_error;
}

/// Rounds floats whose step is not given to the widest step that the bound allows. False: nothing
/// done.
bool EncodeJob::widenSteps(double bound) {
  EncodedHeights& g = *geometry_;
  if (heights_->sample != TKS_F32 || heights_->step > 0 || 2 * bound <= g.steps.step) return false;
  Result<HeightSteps> wide = toSteps(*heights_, {.given = 2 * bound});
  if (!wide.ok()) return false;
  g.steps = std::move(*wide);
  encodeRounded();
  return true;
}

/// Rounds to multiples of the exact step.
void EncodeJob::roundHeights(int32_t largest) {
  EncodedHeights& g = *geometry_;
  if (largest > 0) {
    for (int32_t& q : g.steps.steps) q = nearestMultiple(q, largest);
    g.steps.step *= 2 * largest + 1;
    g.steps.exact = false;
    g.steps.range_bits = std::max(g.steps.range_bits - std::ilogb(2 * largest + 1), 1);
  }
  encodeRounded();
}

void EncodeJob::encodeRounded() {
  EncodedHeights& g = *geometry_;
  if (!g.steps.exact) g.left = g.squaresOf(*heights_, g.steps);
  encodeGeometry(Purpose::kLossless);
}

void EncodeJob::correctHeights(int32_t largest, std::optional<double> mean_square) {
  EncodedHeights& g = *geometry_;
  const EncodedTrack whole = std::move(encodeCoefficients().front());
  GeometryHeader header = *makeHeader(0, false).geometry;
  header.planes = static_cast<uint8_t>(whole.planes);
  const CorrectedCut cut_of(g.steps, header, whole, largest);
  const uint64_t bytes = mean_square ? cut_of.bytesFor(*mean_square) : cut_of.best();
  const Corrected corrected = cut_of.correct(bytes);
  EncodedTrack cut = whole;
  cut.codeword.resize(bytes);
  std::erase_if(cut.points, [&](const RatePoint& p) { return p.bytes > 0 && p.bytes >= bytes; });
  cut.complete = false;
  const double distortion = distortionAt(whole.points, bytes);
  if (bytes > 0) cut.points.push_back({bytes, distortion});
  if (!corrected.codeword.empty()) {
    g.corrections = corrected.codeword;
    g.layers.corrections = CorrectionKind::kSteps;
    g.layers.correction_step = static_cast<uint32_t>(2 * largest + 1);
  }
  joinLayers({cut});
  // In the account's own measure, which the audit corrects later.
  if (!corrected.codeword.empty()) {
    g.tracks.front().points.back().distortion = distortion * corrected.after / corrected.before;
  }
}

}  // namespace tetrakis
