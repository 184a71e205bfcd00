// SPDX-License-Identifier: Apache-2.0
// The plane is transformed as it is, and with areas held. The estimated bytes of its coefficients
// (codec/wavelet/choice/plane_cost.hpp) and the bytes of the areas decide: at the step of the
// target, and at coarser ones, because every prefix pays for the areas first. Large areas are tried
// first; then smaller ones are added, or shapes are simplified, whichever gains.
#include "codec/geometry/coding_choice/flat_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "base/forest.hpp"
#include "codec/geometry/coding_choice/tried_plane.hpp"
#include "codec/geometry/flat/flat_encoder.hpp"
#include "codec/wavelet/choice/plane_cost.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"

namespace tetrakis::inline coding_choice {

namespace {

/// Samples of the smallest flat areas. Smaller ones save bytes at the last bit, and every prefix
/// pays for their shapes first.
constexpr uint32_t kLeastSamples = 8;
/// The shapes to try, from those of the fewest bytes to those that cover the most water: the least
/// samples of an area, and the square that opens it. More shapes take the time of a trial each.
constexpr std::array<FlatShape, 8> kShapes = {
    {{4096, 32}, {4096, 16}, {4096, 8}, {4096, 4}, {4096}, {512}, {64}, {kLeastSamples}}};
/// The place in kShapes of the shape that is tried first.
constexpr size_t kLargeAreas = 4;
/// No shapes are tried where areas of kPond samples cover a smaller share of the plane than one of
/// kLeastShare. A larger kPond and a smaller kLeastShare save time, and miss small lakes.
constexpr uint32_t kPond = 64;
constexpr uint64_t kLeastShare = 1000;
/// A gain below this is within the error of the estimates. Parts miss coarse levels, so their
/// estimates are worse. Larger numbers hold areas that lose bytes, smaller ones miss some that
/// gain.
constexpr double kClearlyOfPlane = 0.99, kClearlyOfParts = 0.98;
/// The worth, as a share of the bytes, of a plane whose samples are all flat and stay so: squared
/// errors do not tell that a sea with waves looks wrong. A larger worth takes bytes for it.
constexpr double kWorthOfFlatness = 0.1;
/// Bits of the header that areas take. A larger number leaves out areas of small planes.
constexpr double kHeaderBits = 64;

/// The step, in units of the plane, that the purpose asks for.
double stepOf(const TriedPlane& plane, const HeightPurpose& purpose, int fraction_bits) {
  if (purpose.purpose == Purpose::kLossless) return 0;
  if (purpose.mean_square > 0)
    return std::ldexp(std::sqrt(12 * purpose.mean_square), fraction_bits);
  return plane.step(8 * static_cast<double>(purpose.bytes));
}

/// The bits or the error that the purpose leaves for a sample of the plane.
RateTarget rateOf(const PlaneView<const int32_t>& plane, const HeightPurpose& purpose) {
  if (purpose.mean_square > 0) return {.mean_square = purpose.mean_square};
  if (purpose.bytes == UINT64_MAX) return {};
  const auto samples = static_cast<double>(markedIn(plane.extent(), plane.valid));
  return {.bits = 8 * static_cast<double>(purpose.bytes) / std::max(samples, 1.0)};
}

/// Compares trials of areas with the best trial so far.
class FlatTrials {
 public:
  FlatTrials(const PlaneView<const int32_t>& heights, Mask valid, const HeightPurpose& purpose)
      : heights_(heights),
        valid_(valid),
        purpose_(purpose),
        finder_({heights.values(), heights.extent(), valid}, purpose.forest.get()),
        wavelet_(chooseWavelet(heights, purpose.range_bits, purpose.purpose,
                               rateOf(heights, purpose))) {}

  FlatChoice choose() {
    FlatChoice plain = {{}, wavelet_};
    const uint64_t samples = heights_.extent().samples();
    if (finder_.samplesOf(kPond, whole()) * kLeastShare < samples) return plain;
    for (const SampledPart& part : sampleParts(finder_, kPond, kLeastSamples, heights_.patch_rows))
      parts_.emplace_back(heights_, valid_, part);
    const Trial best = bestTrial();
    if (best.price != kNoAreas) plain.flat.ratio = best.ratio;
    if (!pays(best)) return plain;
    FlatLayer flat{finder_.areas(best.shape, whole()), {}, best.ratio};
    if (flat.areas.empty()) return plain;  // there are too many
    flat.codeword = encodeFlatAreas(flat.areas, heights_.extent(), codedMask());
    if (flat.codeword.size() >= purpose_.bytes) return plain;
    return {std::move(flat), *beside_};
  }

 private:
  /// The samples of which the mask of areas tells.
  std::vector<uint8_t> codedMask() const {
    if (purpose_.forest != nullptr) return ownedSamples(*purpose_.forest).bytes();
    return {valid_.bytes().begin(), valid_.bytes().end()};
  }
  Window whole() const { return {0, 0, heights_.width, heights_.height}; }

  /// The price of a trial: its bytes over those of the plane without flat areas, less the worth of
  /// flat water (kNoAreas: the trial has no areas).
  static constexpr double kNoAreas = std::numeric_limits<double>::infinity();

  struct Trial {
    FlatShape shape;
    double price = kNoAreas;
    double ratio = 1;  ///< of bytes: the price without the worth of flat water
  };

  ComparedSteps stepsOfPlain() const {
    std::vector<PartTrials> as_it_is(parts_.begin(), parts_.end());
    const TriedPlane plain(as_it_is, std::vector<FlatAreas>(parts_.size()), wavelet_,
                           purpose_.threads);
    return {[&](double step) { return plain.cost(step); },
            stepOf(plain, purpose_, wavelet_.fraction_bits),
            static_cast<double>(heights_.extent().samples())};
  }

  /// The shape of the lowest price. Smaller areas are added if simpler shapes do not gain.
  Trial bestTrial() {
    const ComparedSteps steps = stepsOfPlain();
    const Trial large = tried(kShapes[kLargeAreas], steps);
    Trial best = large;
    if (purpose_.seen) best = tryAll(large, {kShapes.rend() - kLargeAreas, kShapes.rend()}, steps);
    if (best.price == large.price || large.price == kNoAreas) {
      const Trial fine = tryAll(large, {kShapes.begin() + kLargeAreas + 1, kShapes.end()}, steps);
      if (fine.price < best.price) best = fine;
    }
    return best;
  }

  bool pays(const Trial& trial) const {
    return trial.price < (parts_.size() > 1 ? kClearlyOfParts : kClearlyOfPlane);
  }

  /// The best of the shapes, which are tried until prices rise.
  Trial tryAll(const Trial& first, std::vector<FlatShape> shapes, const ComparedSteps& steps) {
    Trial best = first;
    double before = first.price;
    for (const FlatShape& shape : shapes) {
      const Trial trial = tried(shape, steps);
      if (trial.price < best.price) best = trial;
      if (trial.price > before) break;
      before = trial.price;
    }
    return best;
  }

  Trial tried(const FlatShape& shape, const ComparedSteps& steps) {
    std::vector<FlatAreas> areas;
    double held = 0;
    for (const CopiedPart& part : parts_) {
      areas.push_back(finder_.areas(shape, part.place.window));
      const std::vector<uint16_t>& numbers = areas.back().numbers;
      held += part.place.stands_for *
              static_cast<double>(
                  std::count_if(numbers.begin(), numbers.end(), [](uint16_t n) { return n != 0; }));
    }
    if (held == 0) return {shape};
    const auto known = trial_of_held_.find(held);  // the same areas
    if (known != trial_of_held_.end()) return {shape, known->second.price, known->second.ratio};
    const double share = held / static_cast<double>(heights_.extent().samples());
    const double worth = purpose_.seen ? kWorthOfFlatness * share : 0;
    const double ratio = ratioOf(std::move(areas), shape, steps);
    return trial_of_held_[held] = {shape, ratio - worth, ratio};
  }

  double ratioOf(std::vector<FlatAreas> areas, const FlatShape& shape, const ComparedSteps& steps) {
    if (!beside_) {
      beside_ = waveletBeside(finder_.areas(shape, whole()));
      trials_ = std::vector<PartTrials>(parts_.begin(), parts_.end());
    }
    const TriedPlane plane(trials_, std::move(areas), *beside_, purpose_.threads);
    return steps.ratio([&](double step) { return plane.cost(step); },
                       kHeaderBits + plane.bitsOfAreas());
  }

  /// Early doubling is cheap where levels are lifted jointly. Beside held samples levels are not,
  /// but on forests. There filters have two steps (codec/wavelet/held_cells.hpp).
  WaveletHeader waveletBeside(const FlatAreas& areas) const {
    WaveletHeader header = chooseWavelet(heights_, areas.held(), purpose_.range_bits,
                                         purpose_.purpose, rateOf(heights_, purpose_));
    for (uint8_t& filter : header.filters) {
      if (purpose_.forest != nullptr && !liftsJointly(static_cast<FilterId>(filter)))
        filter = static_cast<uint8_t>(FilterId::kLong);
    }
    if (header.first_doubled > 0 && purpose_.forest == nullptr)
      header.first_doubled = static_cast<uint8_t>(WaveletSpec().first_doubled);
    return header;
  }

  const PlaneView<const int32_t>& heights_;
  Mask valid_;
  const HeightPurpose& purpose_;
  FlatFinder finder_;
  std::vector<CopiedPart> parts_;
  std::map<double, Trial> trial_of_held_;
  WaveletHeader wavelet_;                ///< of the plane as it is
  std::optional<WaveletHeader> beside_;  ///< for the samples that the first areas leave
  std::vector<PartTrials> trials_;       ///< of that wavelet
};

}  // namespace

FlatChoice chooseFlatAreas(const PlaneView<const int32_t>& heights, Mask valid,
                           const HeightPurpose& purpose) {
  return FlatTrials(heights, valid, purpose).choose();
}

}  // namespace tetrakis::inline coding_choice
