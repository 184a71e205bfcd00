// SPDX-License-Identifier: Apache-2.0
// The plane is transformed as it is, and with areas held; what its coefficients cost
// (wavelet/plane_cost.hpp) decides, with the bytes of the areas. Small areas are tried by
// themselves: ponds pay, plateaus of whole metres do not, and where bytes are few, only large areas
// do.
#include "codec/geometry/flat_choice.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "codec/geometry/flat_encoder.hpp"
#include "wavelet/plane_cost.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis::inline geometry {

namespace {

constexpr std::array<uint32_t, 3> kLeast = {8, 64, 1024};  ///< samples of the areas tried
/// It is not worth looking where areas of so many samples do not cover that share of the plane.
constexpr uint32_t kLarge = 64;
constexpr uint64_t kLeastShare = 1000;

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
  double step(double bits) const { return stepFor(layout_, values_, bits); }
  double bits(double step) const { return costOf(layout_, values_, step).joint(step); }

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

}  // namespace

FlatChoice chooseFlatAreas(const PlaneView<const int32_t>& heights, const HeightPurpose& purpose) {
  FlatChoice best{{}, chooseWavelet(heights, purpose.range_bits, purpose.purpose)};
  const FlatFinder finder(heights);
  const uint64_t samples = heights.extent().samples();
  if (finder.samplesOf(kLarge) * kLeastShare < samples) return best;
  const TriedPlane plain(heights, {}, best.wavelet, purpose.threads);
  const double step = stepOf(plain, purpose, best.wavelet.fraction_bits);
  double least_bits = plain.bits(step);
  std::optional<WaveletHeader> wavelet;
  for (const uint32_t least : kLeast) {
    FlatLayer flat{finder.areas(least), {}};
    if (flat.areas.empty()) continue;
    flat.codeword = encodeFlatAreas(flat.areas, heights.extent(), heights.valid);
    if (flat.codeword.size() >= purpose.bytes) continue;
    if (!wavelet)
      wavelet = chooseWavelet(heights, flat.areas.held(), purpose.range_bits, purpose.purpose);
    const double bits = TriedPlane(heights, flat.areas, *wavelet, purpose.threads).bits(step) +
                        8 * static_cast<double>(flat.codeword.size());
    if (getenv("TKS_V")) fprintf(stderr, "least %u areas %zu bytes %zu: %.0f of %.0f step %g\n", least, flat.areas.levels.size(), flat.codeword.size(), bits/8, least_bits/8, step);
    if (bits >= least_bits) continue;
    least_bits = bits;
    best = {std::move(flat), *wavelet};
  }
  return best;
}

}  // namespace tetrakis::inline geometry
