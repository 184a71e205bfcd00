// SPDX-License-Identifier: Apache-2.0
// The plane is transformed as it is, and with areas held; what its coefficients cost
// (wavelet/choice/plane_cost.hpp) decides, with the bytes of the areas: at the step of the target,
// and at coarser ones, because every prefix pays for the areas first. Large areas are tried first;
// then smaller ones are added, or shapes are simplified, whichever gains.
#include "codec/geometry/flat_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "base/parallel.hpp"
#include "codec/geometry/flat/flat_encoder.hpp"
#include "codec/geometry/flat/flat_parts.hpp"
#include "wavelet/choice/compared_steps.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis::inline geometry {

namespace {

/// What is tried, from the shapes of the fewest bytes to the most water.
constexpr uint32_t kLeastSamples = 8;
constexpr std::array<FlatShape, 8> kShapes = {
    {{4096, 32}, {4096, 16}, {4096, 8}, {4096, 4}, {4096}, {512}, {64}, {kLeastSamples}}};
constexpr size_t kLargeAreas = 4;
/// Nothing is tried where areas of kPond samples cover less than that share of the plane.
constexpr uint32_t kPond = 64;
constexpr uint64_t kLeastShare = 1000;
/// Estimates of bits are no better than that. Parts miss coarse levels, so theirs are worse.
constexpr double kClearlyOfPlane = 0.99, kClearlyOfParts = 0.98;
/// What it is worth, as a share of the bytes, that all samples are flat and stay so: squared errors
/// do not tell that a sea with waves looks wrong.
constexpr double kWorthOfFlatness = 0.1;

/// A part, copied from the plane.
struct CopiedPart {
  SampledPart place;
  std::vector<int32_t> heights;
  std::vector<uint8_t> lifted, valid;

  CopiedPart(const PlaneView<const int32_t>& plane, Mask valid_samples, const SampledPart& sampled)
      : place(sampled),
        heights(cut(plane.values(), plane.extent(), {0, sampled.window})),
        lifted(cut(plane.valid.bytes(), plane.extent(), {0, sampled.window})),
        valid(cut(valid_samples.bytes(), plane.extent(), {0, sampled.window})) {}
  Extent extent() const { return place.window.extent(); }
};

/// A part, transformed. What it has been found to cost is kept.
class TriedPart {
 public:
  /// The part outlives this.
  TriedPart(const CopiedPart& part, FlatAreas flat, const WaveletHeader& wavelet)
      : flat_(std::move(flat)),
        values_(scaled(part.heights, wavelet)),
        area_heights_(scaled(flat_.heights, wavelet)),
        layout_(specOf(wavelet), part.extent(), part.lifted, {flat_.numbers, area_heights_}) {
    clearUnmarked(std::span(values_), part.lifted);
    forwardWavelet(specOf(wavelet), layout_.pyramid(), values_, 1);
    if (!flat_.empty()) bytes_of_areas_ = encodeFlatAreas(flat_, part.extent(), part.valid).size();
  }
  TriedPart(const TriedPart&) = delete;  // the layout refers to it
  TriedPart& operator=(const TriedPart&) = delete;

  PlaneCost cost(double step) {
    const auto [known, is_new] = costs_.try_emplace(step);
    if (is_new) known->second = costOf(layout_, values_, step);
    return known->second;
  }
  bool holds(const FlatAreas& flat) const { return flat_.numbers == flat.numbers; }
  size_t bytesOfAreas() const { return bytes_of_areas_; }

 private:
  static std::vector<int32_t> scaled(std::span<const int32_t> heights,
                                     const WaveletHeader& wavelet) {
    std::vector<int32_t> values(heights.begin(), heights.end());
    for (int32_t& h : values)
      h = static_cast<int32_t>(static_cast<uint32_t>(h) << wavelet.fraction_bits);
    return values;
  }

  FlatAreas flat_;
  std::vector<int32_t> values_, area_heights_;
  PlaneLayout layout_;
  size_t bytes_of_areas_ = 0;
  std::map<double, PlaneCost> costs_;  ///< by the step
};

/// What a part costs with one wavelet and the areas of several shapes, which it often shows alike.
class PartTrials {
 public:
  /// The part outlives this.
  explicit PartTrials(const CopiedPart& part) : part_(&part) {}

  TriedPart& tried(FlatAreas flat, const WaveletHeader& wavelet) {
    for (const auto& before : tried_) {
      if (before->holds(flat)) return *before;
    }
    if (tried_.size() == kKept) tried_.pop_back();
    return *tried_.emplace_back(std::make_unique<TriedPart>(*part_, std::move(flat), wavelet));
  }
  double standsFor() const { return part_->place.stands_for; }

 private:
  /// The first, which often has no areas, and the last one: more would take memory.
  static constexpr size_t kKept = 2;

  const CopiedPart* part_;
  std::vector<std::unique_ptr<TriedPart>> tried_;
};

/// Parts that stand for a plane, and what that costs.
class TriedPlane {
 public:
  /// trials: of the wavelet; they outlive this. areas: of each part.
  TriedPlane(std::vector<PartTrials>& trials, std::vector<FlatAreas> areas,
             const WaveletHeader& wavelet, uint32_t threads)
      : parts_(trials.size()), threads_(threads) {
    parallelFor(threads_, parts_.size(), [&](size_t i) {
      parts_[i] = {&trials[i].tried(std::move(areas[i]), wavelet), trials[i].standsFor()};
    });
  }
  PlaneCost cost(double step) const {
    std::vector<PlaneCost> costs(parts_.size());
    parallelFor(threads_, costs.size(), [&](size_t i) { costs[i] = parts_[i].tried->cost(step); });
    PlaneCost sum;
    for (size_t i = 0; i < costs.size(); ++i) {
      sum.bits += parts_[i].stands_for * costs[i].bits;
      sum.squares += parts_[i].stands_for * costs[i].squares;
    }
    return sum;
  }
  double bitsOfAreas() const {
    double bits = 0;
    for (const Part& part : parts_)
      bits += part.stands_for * 8 * static_cast<double>(part.tried->bytesOfAreas());
    return bits;
  }
  /// The least power of two at which the coefficients cost at most so many bits.
  double step(double bits) const {
    constexpr int kMost = 60;
    const auto fits = [&](int log2) { return cost(std::exp2(log2)).bits <= bits; };
    int too_fine = -1, enough = 0;
    for (; enough < kMost && !fits(enough); enough += 4) too_fine = enough;
    while (enough - too_fine > 1) {
      const int middle = (enough + too_fine) / 2;
      (fits(middle) ? enough : too_fine) = middle;
    }
    return std::exp2(enough);
  }

 private:
  struct Part {
    TriedPart* tried = nullptr;
    double stands_for = 0;
  };
  std::vector<Part> parts_;
  uint32_t threads_;
};

/// The step, in units of the plane, that the purpose asks for.
double stepOf(const TriedPlane& plane, const HeightPurpose& purpose, int fraction_bits) {
  if (purpose.purpose == Purpose::kLossless) return 0;
  if (purpose.mean_square > 0)
    return std::ldexp(std::sqrt(12 * purpose.mean_square), fraction_bits);
  return plane.step(8 * static_cast<double>(purpose.bytes));
}

/// Tries areas against what was best so far.
class FlatTrials {
 public:
  FlatTrials(const PlaneView<const int32_t>& heights, Mask valid, const HeightPurpose& purpose)
      : heights_(heights),
        valid_(valid),
        purpose_(purpose),
        finder_({heights.values(), heights.extent(), valid}),
        wavelet_(chooseWavelet(heights, purpose.range_bits, purpose.purpose)) {}

  FlatChoice choose() {
    const FlatChoice plain = {{}, wavelet_};
    const uint64_t samples = heights_.extent().samples();
    if (finder_.samplesOf(kPond, whole()) * kLeastShare < samples) return plain;
    for (const SampledPart& part : sampleParts(finder_, kPond, kLeastSamples))
      parts_.emplace_back(heights_, valid_, part);
    const std::optional<FlatShape> shape = shapeThatPays();
    if (!shape) return plain;
    FlatLayer flat{finder_.areas(*shape, whole()), {}};
    if (flat.areas.empty()) return plain;  // there are too many
    flat.codeword = encodeFlatAreas(flat.areas, heights_.extent(), valid_);
    if (flat.codeword.size() >= purpose_.bytes) return plain;
    return {std::move(flat), *beside_};
  }

 private:
  Window whole() const { return {0, 0, heights_.width, heights_.height}; }

  /// A price is the ratio of bytes, less what flatness is worth; it is infinite without areas.
  static constexpr double kNoAreas = std::numeric_limits<double>::infinity();

  struct Trial {
    FlatShape shape;
    double price = kNoAreas;
  };

  ComparedSteps stepsOfPlain() const {
    std::vector<PartTrials> as_it_is(parts_.begin(), parts_.end());
    const TriedPlane plain(as_it_is, std::vector<FlatAreas>(parts_.size()), wavelet_,
                           purpose_.threads);
    return {[&](double step) { return plain.cost(step); },
            stepOf(plain, purpose_, wavelet_.fraction_bits),
            static_cast<double>(heights_.extent().samples())};
  }

  /// The shape that pays best; nothing: none does. Smaller areas are added if simpler shapes do not
  /// gain.
  std::optional<FlatShape> shapeThatPays() {
    const ComparedSteps steps = stepsOfPlain();
    const Trial large = {kShapes[kLargeAreas], priceOf(kShapes[kLargeAreas], steps)};
    Trial best = large;
    if (purpose_.seen) best = tryAll(large, {kShapes.rend() - kLargeAreas, kShapes.rend()}, steps);
    if (best.price == large.price || large.price == kNoAreas) {
      const Trial fine = tryAll(large, {kShapes.begin() + kLargeAreas + 1, kShapes.end()}, steps);
      if (fine.price < best.price) best = fine;
    }
    const double clearly = parts_.size() > 1 ? kClearlyOfParts : kClearlyOfPlane;
    if (best.price >= clearly) return {};
    return best.shape;
  }

  /// The best of them all, which are tried until prices rise.
  Trial tryAll(const Trial& first, std::vector<FlatShape> shapes, const ComparedSteps& steps) {
    Trial best = first;
    double before = first.price;
    for (const FlatShape& shape : shapes) {
      const double price = priceOf(shape, steps);
      if (price < best.price) best = {shape, price};
      if (price > before) break;
      before = price;
    }
    return best;
  }

  double priceOf(const FlatShape& shape, const ComparedSteps& steps) {
    std::vector<FlatAreas> areas;
    double held = 0;
    for (const CopiedPart& part : parts_) {
      areas.push_back(finder_.areas(shape, part.place.window));
      const std::vector<uint16_t>& numbers = areas.back().numbers;
      held += part.place.stands_for *
              static_cast<double>(
                  std::count_if(numbers.begin(), numbers.end(), [](uint16_t n) { return n != 0; }));
    }
    if (held == 0) return kNoAreas;
    const auto known = price_of_held_.find(held);  // the same areas
    if (known != price_of_held_.end()) return known->second;
    const double share = held / static_cast<double>(heights_.extent().samples());
    const double worth = purpose_.seen ? kWorthOfFlatness * share : 0;
    return price_of_held_[held] = ratioOf(std::move(areas), shape, steps) - worth;
  }

  double ratioOf(std::vector<FlatAreas> areas, const FlatShape& shape, const ComparedSteps& steps) {
    constexpr double kHeaderBits = 64;  // what the header says of them
    if (!beside_) {
      beside_ = waveletBeside(finder_.areas(shape, whole()));
      trials_ = std::vector<PartTrials>(parts_.begin(), parts_.end());
    }
    const TriedPlane plane(trials_, std::move(areas), *beside_, purpose_.threads);
    return steps.ratio([&](double step) { return plane.cost(step); },
                       kHeaderBits + plane.bitsOfAreas());
  }

  /// Early doubling is cheap where levels are lifted jointly. Beside held samples they are not.
  WaveletHeader waveletBeside(const FlatAreas& areas) const {
    WaveletHeader header =
        chooseWavelet(heights_, areas.held(), purpose_.range_bits, purpose_.purpose);
    if (header.first_doubled > 0) header.first_doubled = WaveletSpec().first_doubled;
    return header;
  }

  const PlaneView<const int32_t>& heights_;
  Mask valid_;
  const HeightPurpose& purpose_;
  FlatFinder finder_;
  std::vector<CopiedPart> parts_;
  std::map<double, double> price_of_held_;
  WaveletHeader wavelet_;                ///< of the plane as it is
  std::optional<WaveletHeader> beside_;  ///< that suits what the first areas leave
  std::vector<PartTrials> trials_;       ///< of that wavelet
};

}  // namespace

FlatChoice chooseFlatAreas(const PlaneView<const int32_t>& heights, Mask valid,
                           const HeightPurpose& purpose) {
  return FlatTrials(heights, valid, purpose).choose();
}

}  // namespace tetrakis::inline geometry
