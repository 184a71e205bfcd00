// SPDX-License-Identifier: Apache-2.0
// Heights within a largest error. Two ways, and the one of fewer bytes is kept:
//
//   round     heights become multiples of 2 e + 1 steps (floats of twice the bound) and are coded
//   to the last bit. Best where
//             the error wanted is near the noise of the heights.
//   correct   the coefficients are cut, and what then is off by more than e gets a correction in
//             multiples of 2 e + 1. Best above: at 5 m on mountains half the bytes of rounding.
//
// Cutting so late that nothing is off by more than e takes up to twice the bytes of either.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "api/encode_job.hpp"
#include "api/sample_order.hpp"
#include "api/voids.hpp"
#include "codec/corrections_encoder.hpp"

namespace tetrakis {

namespace {

/// The multiple of 2 * largest + 1 nearest to q.
int32_t nearestMultiple(int64_t q, int64_t largest) {
  const int64_t unit = 2 * largest + 1, shifted = q + largest;
  return static_cast<int32_t>((shifted - (shifted % unit + unit) % unit) / unit);
}

/// Squared error that the account states for that many bytes; linear between its points.
double distortionAt(const std::vector<RatePoint>& points, uint64_t bytes) {
  const auto after = std::find_if(points.begin(), points.end(),
                                  [&](const RatePoint& point) { return point.bytes > bytes; });
  if (after == points.begin() || after == points.end()) return points.back().distortion;
  const RatePoint &a = *(after - 1), &b = *after;
  const double t = static_cast<double>(bytes - a.bytes) / static_cast<double>(b.bytes - a.bytes);
  return a.distortion + t * (b.distortion - a.distortion);
}

/// What corrections make of the heights that a cut leaves.
struct Corrected {
  std::vector<uint8_t> codeword;  ///< empty: nothing needs one
  double before = 0, after = 0;   ///< squared errors in steps
};

/// Tries cuts of one track of coefficients.
class Cutter {
 public:
  Cutter(const EncodedHeights& heights, const GeometryHeader& header,
         const EncodedTrack& coefficients, int32_t largest)
      : heights_(heights), header_(header), coefficients_(coefficients), largest_(largest) {}

  Corrected correct(uint64_t bytes) const {
    const DecodedGeometry decoded = decodeGeometry(
        header_, {std::span(coefficients_.codeword).first(bytes)}, heights_.steps.valid);
    const std::vector<int32_t> steps = wholeSteps(decoded);
    Corrected result;
    std::vector<int32_t> corrections(steps.size());
    bool any = false;
    for (size_t i = 0; i < corrections.size(); ++i) {
      const int64_t error = int64_t{heights_.steps.steps[i]} - steps[i];
      corrections[i] = nearestMultiple(error, largest_);
      any |= corrections[i] != 0;
      const auto rest = static_cast<double>(error - int64_t{corrections[i]} * (2 * largest_ + 1));
      result.before += static_cast<double>(error) * static_cast<double>(error);
      result.after += rest * rest;
    }
    if (!any) return result;
    const std::vector<uint8_t> hints = activityHints(decoded, header_.width, header_.height);
    result.codeword = encodeCorrections(
        corrections, {header_.width, header_.height, heights_.steps.valid, hints});
    return result;
  }

  /// The cut of fewest bytes in all. The bytes have one minimum, usually where the RMSE is 0.3 to
  /// 0.6 of the largest error: descent from there with ever smaller strides.
  uint64_t best() const {
    const double wanted = 0.45 * largest_ * 0.45 * largest_;
    const auto samples = static_cast<double>(heights_.steps.validCount());
    uint64_t best = coefficients_.codeword.size();
    for (const RatePoint& point : coefficients_.points) {
      if (point.distortion > wanted * samples) continue;
      best = std::min(best, point.bytes);
      break;
    }
    uint64_t least = total(best);
    for (const double stride : {1.3, 1.1, 1.04}) {
      for (const double factor : {1 / stride, stride}) {
        for (;;) {
          const uint64_t cut =
              std::min<uint64_t>(static_cast<uint64_t>(static_cast<double>(best) * factor),
                                 coefficients_.codeword.size());
          const uint64_t bytes = total(cut);
          if (bytes >= least) break;
          best = cut;
          least = bytes;
        }
      }
    }
    return best;
  }

 private:
  uint64_t total(uint64_t bytes) const { return bytes + correct(bytes).codeword.size(); }

  const EncodedHeights& heights_;
  const GeometryHeader& header_;
  const EncodedTrack& coefficients_;
  int32_t largest_;
};

}  // namespace

/// Exact steps leave an error of their own; what is left of the bound, in whole steps, the coding
/// may use. Where floats are then rounded beyond the bound one step less will do; none, the exact
/// steps, is always within.
void EncodeJob::boundHeights() {
  if (geometry_->layers.corrections == CorrectionKind::kSamples) return;
  const EncodedHeights exact = *geometry_;
  std::optional<EncodedHeights> best;
  const auto consider = [&] {
    const uint64_t bytes = bytesOf(geometry_->tracks);
    const bool within = withinBound();
    if (within && (!best || bytes < bytesOf(best->tracks))) best = std::move(*geometry_);
    geometry_ = exact;
    return within;
  };
  const double bound = options_.max_error / std::abs(heights_->scale);
  const double room = (bound - errorsOf(*heights_, exact.steps).largest) / exact.steps.step;
  constexpr double kMost = 1 << 24;
  auto largest = static_cast<int32_t>(std::clamp(room + 1e-9, 0.0, kMost));
  if (widenSteps(bound - floatSpacing() / 2)) consider();
  for (bool within = false; !within && largest >= 0; --largest) {
    roundHeights(largest);
    within = consider();
    if (largest == 0) break;
    if (geometry_->tracks.size() > 1) continue;  // one codeword is cut, not many
    correctHeights(largest);
    within |= consider();
  }
  if (best) geometry_ = std::move(best);
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

void EncodeJob::correctHeights(int32_t largest) {
  EncodedHeights& g = *geometry_;
  const EncodedTrack whole = std::move(encodeCoefficients().front());
  GeometryHeader header = *makeHeader(0, false).geometry;
  header.planes = static_cast<uint8_t>(whole.planes);
  const Cutter cutter(g, header, whole, largest);
  const uint64_t bytes = cutter.best();
  const Corrected corrected = cutter.correct(bytes);
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
