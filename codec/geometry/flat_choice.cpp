// SPDX-License-Identifier: Apache-2.0
// The plane is transformed as it is, and with areas held; what its coefficients cost
// (wavelet/plane_cost.hpp) decides, with the bytes of the areas: at the step of the target, and at
// coarser ones, because every prefix pays for the areas first. Large areas are tried before smaller
// ones are added.
#include "codec/geometry/flat_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "codec/geometry/flat_encoder.hpp"
#include "wavelet/plane_cost.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis::inline geometry {

namespace {

/// Least samples of the areas that are tried, one after the other.
constexpr uint32_t kLeastSamples[] = {4096, 512, 64, 8};
/// Nothing is tried where areas of kPond samples cover less than that share of the plane.
constexpr uint32_t kPond = 64;
constexpr uint64_t kLeastShare = 1000;
/// Estimates of bits are not better than that.
constexpr double kClearly = 0.99;

/// With what the header says of them.
double bitsOf(const FlatLayer& flat) {
  constexpr size_t kHeaderBytes = 8;
  return flat.codeword.empty() ? 0 : 8 * static_cast<double>(flat.codeword.size() + kHeaderBytes);
}

/// Heights, transformed, and what they cost.
class TriedPlane {
 public:
  TriedPlane(const PlaneView<const int32_t>& heights, const FlatAreas& flat,
             const WaveletHeader& wavelet, uint32_t threads)
      : values_(scaled(heights.values(), wavelet)),
        levels_(scaled(flat.levels, wavelet)),
        layout_(specOf(wavelet), heights.extent(), heights.valid, {flat.numbers, levels_}) {
    clearUnmarked(std::span(values_), heights.valid);
    forwardWavelet(specOf(wavelet), layout_.pyramid(), values_, threads);
  }
  PlaneCost cost(double step) const { return costOf(layout_, values_, step); }
  /// At which the coefficients cost at most so many bits.
  double step(double bits) const {
    double step = stepFor(layout_, values_, bits);
    while (cost(step).bits > bits) step *= 2;
    return step;
  }

 private:
  static std::vector<int32_t> scaled(std::span<const int32_t> heights,
                                     const WaveletHeader& wavelet) {
    std::vector<int32_t> values(heights.begin(), heights.end());
    for (int32_t& h : values)
      h = static_cast<int32_t>(static_cast<uint32_t>(h) << wavelet.fraction_bits);
    return values;
  }

  std::vector<int32_t> values_, levels_;
  PlaneLayout layout_;
};

/// The step, in units of the plane, that the purpose asks for.
double stepOf(const TriedPlane& plane, const HeightPurpose& purpose, int fraction_bits) {
  if (purpose.purpose == Purpose::kLossless) return 0;
  if (purpose.mean_square > 0)
    return std::ldexp(std::sqrt(12 * purpose.mean_square), fraction_bits);
  return plane.step(8 * static_cast<double>(purpose.bytes));
}

/// Steps at which planes are compared: that of the target, and those of prefixes, 12 dB apart.
class ComparedSteps {
 public:
  /// plain: without areas.
  ComparedSteps(const TriedPlane& plain, double target, double samples) {
    for (double step = target;; step = step == 0 ? kFirstLossy : kApart * step) {
      const PlaneCost cost = plain.cost(step);
      if (!plain_.empty() && cost.bits < kLeastBits * samples) return;
      plain_.push_back({step, cost.bits, cost.joint(step)});
    }
  }

  /// How many times the bytes of equal quality are what they are without areas: the geometric mean
  /// over prefixes, and beside it, as much as all of them, the target.
  double ratio(const TriedPlane& plane, double more_bits) const {
    const double target = logRatio(plain_.front(), plane, more_bits);
    if (plain_.size() == 1) return std::exp(target);
    double prefixes = 0;
    for (size_t i = 1; i < plain_.size(); ++i) prefixes += logRatio(plain_[i], plane, more_bits);
    return std::exp((target + prefixes / static_cast<double>(plain_.size() - 1)) / 2);
  }

 private:
  static constexpr double kApart = 4, kFirstLossy = 2;
  static constexpr double kLeastBits = 0.05;  ///< a sample, of prefixes
  static constexpr double kLeastRatio = 0.05;

  struct Plain {
    double step, bits, joint;
  };

  static double logRatio(const Plain& plain, const TriedPlane& plane, double more_bits) {
    const double change = plane.cost(plain.step).joint(plain.step) + more_bits - plain.joint;
    return std::log(std::max(1 + change / plain.bits, kLeastRatio));
  }

  std::vector<Plain> plain_;
};

/// Tries areas against what was best so far.
class FlatTrials {
 public:
  FlatTrials(const PlaneView<const int32_t>& heights, const HeightPurpose& purpose)
      : heights_(heights),
        purpose_(purpose),
        finder_(heights),
        best_{{}, chooseWavelet(heights, purpose.range_bits, purpose.purpose)} {}

  FlatChoice choose() {
    if (finder_.samplesOf(kPond) * kLeastShare < heights_.extent().samples()) return best_;
    {
      const TriedPlane plain(heights_, {}, best_.wavelet, purpose_.threads);
      const double step = stepOf(plain, purpose_, best_.wavelet.fraction_bits);
      steps_.emplace(plain, step, static_cast<double>(heights_.extent().samples()));
    }
    double before = std::numeric_limits<double>::infinity();
    size_t areas = 0;
    for (const uint32_t least : kLeastSamples) {
      FlatLayer flat{finder_.areas(least), {}};
      if (flat.areas.levels.size() == areas) continue;
      areas = flat.areas.levels.size();
      const double ratio = tryAreas(std::move(flat));
      if (ratio > before) break;
      before = ratio;
    }
    return std::move(best_);
  }

 private:
  double tryAreas(FlatLayer flat) {
    flat.codeword = encodeFlatAreas(flat.areas, heights_.extent(), heights_.valid);
    if (flat.codeword.size() >= purpose_.bytes) return std::numeric_limits<double>::infinity();
    if (!wavelet_) wavelet_ = waveletBeside(flat.areas);
    const TriedPlane held(heights_, flat.areas, *wavelet_, purpose_.threads);
    const double ratio = steps_->ratio(held, bitsOf(flat));
    if (ratio < best_ratio_) {
      best_ratio_ = ratio;
      best_ = {std::move(flat), *wavelet_};
    }
    return ratio;
  }

  /// Early doubling is cheap where levels are lifted jointly. Beside held samples they are not.
  WaveletHeader waveletBeside(const FlatAreas& areas) const {
    WaveletHeader header =
        chooseWavelet(heights_, areas.held(), purpose_.range_bits, purpose_.purpose);
    if (header.first_doubled > 0) header.first_doubled = WaveletSpec().first_doubled;
    return header;
  }

  const PlaneView<const int32_t>& heights_;
  const HeightPurpose& purpose_;
  FlatFinder finder_;
  FlatChoice best_;
  std::optional<ComparedSteps> steps_;
  double best_ratio_ = kClearly;
  std::optional<WaveletHeader> wavelet_;  ///< that suits what areas leave
};

}  // namespace

FlatChoice chooseFlatAreas(const PlaneView<const int32_t>& heights, const HeightPurpose& purpose) {
  return FlatTrials(heights, purpose).choose();
}

}  // namespace tetrakis::inline geometry
