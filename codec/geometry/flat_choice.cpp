// SPDX-License-Identifier: Apache-2.0
// The plane is transformed as it is, and with areas held; what its coefficients cost
// (wavelet/plane_cost.hpp) decides, with the bytes of the areas. Small areas are tried by
// themselves: ponds pay, plateaus of whole metres do not, and where bytes are few, only large areas
// do.
#include "codec/geometry/flat_choice.hpp"

#include <cmath>
#include <optional>
#include <utility>

#include "codec/geometry/flat_encoder.hpp"
#include "wavelet/plane_cost.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis::inline geometry {

namespace {

/// Least samples of the areas that are tried: first those of kMiddle, and then smaller ones too, or
/// larger ones alone.
constexpr uint32_t kSmall = 8, kMiddle = 64, kLarge = 1024;
/// Nothing is tried where areas of kMiddle samples cover less than that share of the plane.
constexpr uint64_t kLeastShare = 1000;
/// Smaller areas are tried where the first take off so many times what they take.
constexpr double kClearGain = 2;

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

/// Tries areas against what was best so far.
class FlatTrials {
 public:
  FlatTrials(const PlaneView<const int32_t>& heights, const HeightPurpose& purpose)
      : heights_(heights),
        purpose_(purpose),
        finder_(heights),
        best_{{}, chooseWavelet(heights, purpose.range_bits, purpose.purpose)} {}

  FlatChoice choose() {
    if (finder_.samplesOf(kMiddle) * kLeastShare < heights_.extent().samples()) return best_;
    const TriedPlane plain(heights_, {}, best_.wavelet, purpose_.threads);
    step_ = stepOf(plain, purpose_, best_.wavelet.fraction_bits);
    const double bits = plain.cost(step_).joint(step_);
    bits_ = bits;
    tryAreas(kMiddle);
    const bool clear = bits - bits_ > kClearGain * bitsOf(best_.flat);
    tryAreas(clear ? kSmall : kLarge);
    return std::move(best_);
  }

 private:
  void tryAreas(uint32_t least) {
    FlatLayer flat{finder_.areas(least), {}};
    if (flat.areas.empty()) return;
    flat.codeword = encodeFlatAreas(flat.areas, heights_.extent(), heights_.valid);
    if (flat.codeword.size() >= purpose_.bytes) return;
    if (!wavelet_) wavelet_ = waveletBeside(flat.areas);
    const TriedPlane held(heights_, flat.areas, *wavelet_, purpose_.threads);
    const double bits = held.cost(step_).joint(step_) + bitsOf(flat);
    if (bits >= bits_) return;
    bits_ = bits;
    best_ = {std::move(flat), *wavelet_};
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
  double step_ = 0, bits_ = 0;
  std::optional<WaveletHeader> wavelet_;  ///< that suits what areas leave
};

}  // namespace

FlatChoice chooseFlatAreas(const PlaneView<const int32_t>& heights, const HeightPurpose& purpose) {
  return FlatTrials(heights, purpose).choose();
}

}  // namespace tetrakis::inline geometry
