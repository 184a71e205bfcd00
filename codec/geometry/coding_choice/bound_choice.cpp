// SPDX-License-Identifier: Apache-2.0
#include "codec/geometry/coding_choice/cuts.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "codec/geometry/heights_encoder.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"

namespace tetrakis::inline coding_choice {

namespace {

/// For planes of more samples, of which those that patches share count once, typical parts choose
/// one way to keep the bound; smaller planes are coded both ways. A larger number takes twenty
/// times as long as coding does, for better choices.
constexpr uint64_t kSearchedSamples = 1025 * 1025;
/// Samples along a side of the parts. Larger parts choose better, and take time.
constexpr uint32_t kPartSide = 448;
/// The factors of squared errors by which the search for the best cut goes on, in this order.
/// Closer ones find a better cut, and take time.
constexpr std::array<double, 4> kRatios = {2.0, 0.5, 1.3, 1 / 1.3};

HeightSteps cropped(const HeightSteps& whole, Extent plane, const Window& part) {
  HeightSteps out;
  out.range_bits = whole.range_bits;
  out.steps = slice(std::span<const int32_t>(whole.steps), plane, {0, part});
  out.valid = slice(std::span<const uint8_t>(whole.valid), plane, {0, part});
  out.bridge = whole.bridge;
  out.lifted = slice(std::span<const uint8_t>(whole.lifted), plane, {0, part});
  return out;
}

/// A part of the plane, treated as a plane of its own. It cannot be moved.
class PartTrial {
 public:
  PartTrial(HeightSteps steps, const Window& part, const WaveletHeader& wavelet, int32_t largest)
      : steps_(std::move(steps)), largest_(largest) {
    header_.width = part.width;
    header_.height = part.height;
    header_.wavelet = wavelet;
    track_ = coded(steps_.steps, wavelet);
    header_.planes = static_cast<uint8_t>(track_.planes);
  }
  PartTrial(const PartTrial&) = delete;

  uint64_t corrected(double mean_square) { return cut_.total(cut_.bytesFor(mean_square)); }

  /// Bytes of the rounded part: as coefficients to the last bit, or as a cut with exact corrections
  /// where the estimate says that these take fewer bytes.
  uint64_t rounded() const {
    std::vector<int32_t> steps = steps_.steps;
    for (int32_t& q : steps) q = nearestMultiple(q, largest_);
    const PlaneView<const int32_t> plane(steps, header_.extent(), lifted());
    const uint64_t whole =
        coded(steps, chooseWavelet(plane, steps_.range_bits, Purpose::kLossless)).codeword.size();
    const std::optional<ExactCut> cut = chooseExactCut(plane, steps_.range_bits, whole);
    return cut ? static_cast<uint64_t>(cut->bytes) : whole;
  }

 private:
  Mask lifted() const { return steps_.lifting(header_.extent()).valid; }
  EncodedTrack coded(const std::vector<int32_t>& steps, const WaveletHeader& wavelet) const {
    const CoefficientOptions options{.share = steps_.liftedShare()};
    return encodeCoefficients({steps, header_.extent(), lifted()}, wavelet, options).front();
  }

  HeightSteps steps_;
  int32_t largest_;
  const FlatAreas no_areas_;  // they help rounded steps as much as corrected ones
  GeometryHeader header_;
  EncodedTrack track_;
  CorrectedCut cut_{steps_, no_areas_, header_, track_, largest_};
};

/// The cut with which the corrected parts take the fewest bytes.
struct BestCut {
  double mean_square;
  uint64_t bytes;
};

/// Descent by falling ratios; with each ratio, every turn but the last takes fewer bytes than the
/// one before.
BestCut bestCut(std::deque<PartTrial>& trials, int32_t largest) {
  const auto at = [&](double mean_square) {
    BestCut cut{mean_square, 0};
    for (PartTrial& trial : trials) cut.bytes += trial.corrected(mean_square);
    return cut;
  };
  BestCut best = at(usualCut(largest));
  for (const double ratio : kRatios) {
    for (;;) {
      const BestCut next = at(best.mean_square * ratio);
      if (next.bytes >= best.bytes) break;
      best = next;
    }
  }
  return best;
}

/// At least so many places have a sample.
uint64_t placesOf(const HeightSteps& steps, Extent plane) {
  if (steps.patch_rows == 0) return plane.samples();
  return uint64_t{plane.width - 1} * (plane.height / steps.patch_rows) * (steps.patch_rows - 1);
}

}  // namespace

BoundWays boundWays(const HeightSteps& steps, Extent plane, const WaveletHeader& wavelet,
                    int32_t largest) {
  if (largest == 0) return {.correct = false};
  if (placesOf(steps, plane) <= kSearchedSamples) return {};
  return boundWaysByParts(steps, plane, wavelet, largest);
}

BoundWays boundWaysByParts(const HeightSteps& steps, Extent plane, const WaveletHeader& wavelet,
                           int32_t largest) {
  assert(steps.steps.size() == plane.samples());
  std::deque<PartTrial> trials;
  uint64_t rounded = 0, samples = 0;
  const Mask valid = steps.lifting(plane).valid;
  const IsCoded is_coded = valid.all() ? IsCoded() : [&](size_t i) { return valid[i]; };
  for (const Window& part : typicalParts(plane, kPartSide, is_coded, steps.patch_rows)) {
    trials.emplace_back(cropped(steps, plane, part), part, wavelet, largest);
    rounded += trials.back().rounded();
    samples += part.extent().samples();
  }
  const BestCut cut = bestCut(trials, largest);
  const bool correct = cut.bytes < rounded;
  const double parts = static_cast<double>(plane.samples()) / static_cast<double>(samples);
  return {!correct, correct, cut.mean_square, parts * static_cast<double>(rounded),
          parts * static_cast<double>(cut.bytes)};
}

}  // namespace tetrakis::inline coding_choice
