// SPDX-License-Identifier: Apache-2.0
// A coefficient c coded with a step T costs about log2(1 + |c| / T) bits, its norm counted in |c|.
// Of the sums over all details the smallest wins, each made larger by what its filters are known to
// lose besides. For lossy streams, against the best of the choices, found by coding with each, that
// loses up to 0.3 % of the bytes on nine aerial images and maps and on seven DEMs; were kLong not
// made larger, up to 2.5 %. The step T is one that a tenth of the details reach and, where the
// target leaves a finer one, that one as well (docs/EXPERIMENTS.md, "Roofs and walls").
#include "codec/wavelet/choice/filter_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/portable_math.hpp"
#include "codec/wavelet/band_plan.hpp"
#include "codec/wavelet/choice/typical_plane.hpp"
#include "codec/wavelet/wavelet.hpp"

namespace tetrakis::inline choice {

namespace {

using Filters = std::array<uint8_t, WaveletSpec::kChoices>;

constexpr auto kS = static_cast<uint8_t>(FilterId::kShort);
constexpr auto kM = static_cast<uint8_t>(FilterId::kSixTap);
constexpr auto kQ = static_cast<uint8_t>(FilterId::kQuiet);
constexpr auto kO = static_cast<uint8_t>(FilterId::kOrthogonal);
constexpr auto kL = static_cast<uint8_t>(FilterId::kLong);
constexpr auto kN = static_cast<uint8_t>(FilterId::kSmooth);
/// Filters of lossy streams. More choices save bytes, and take the time of a transform of the
/// typical parts each.
constexpr std::array<Filters, 6> kLossyChoices = {
    {{kL, kL, kL}, {kL, kL, kO}, {kL, kO, kO}, {kO, kO, kO}, {kS, kS, kS}, {kN, kN, kN}}};

/// Filters for the last bit, and by how much the estimate of their bits counts more because of what
/// prefixes are worth (docs/EXPERIMENTS.md, "Cuts of lossless streams"). The estimate makes
/// differences of bytes three to four times as large as they are. A larger penalty is worth more
/// bytes to prefixes.
struct LosslessChoice {
  Filters filters;
  double penalty;
};
constexpr std::array<LosslessChoice, 4> kLosslessHeights = {
    {{{kM, kM, kM}, 1.004}, {{kL, kL, kL}, 1}, {{kS, kS, kS}, 1.02}, {{kN, kN, kN}, 1.02}}};

/// Coarse levels of images have a filter that is nearly orthogonal, as in lossy streams.
constexpr std::array<LosslessChoice, 4> kLosslessImages = {
    {{{kL, kQ, kQ}, 1}, {{kL, kL, kQ}, 1.045}, {{kM, kM, kM}, 1.08}, {{kS, kS, kS}, 1.115}}};

/// The share of details other than 0 that the step T leaves above itself. A larger share chooses
/// for higher rates.
constexpr double kSignificant = 0.1;
/// Fraction bits of lossy coefficients. Four save 9 % of the bytes of whole metres against the
/// lossless transform; more would save less noise than they take range.
constexpr int kMostFractionBits = 4;
constexpr int kGrowingBits = 20;  // with more, the low bands of kQuiet and kOrthogonal pass 2^30

/// Doubling low bands after level 2 in the place of level 4 halves the roundings of levels 3 and 4,
/// and takes 1/16 of a bit a sample. That is worth it where few bits are lossless, because then
/// cuts come near to what roundings lose. After levels 1 and 2 doubling takes 9 % of the bytes.
constexpr uint8_t kEarlyDoubled = 2, kLateDoubled = 3;
/// Lossless bits a sample below which low bands are doubled early. Larger numbers take bytes of
/// more streams, and gain quality of their late cuts.
constexpr double kFewBits = 1.6, kFewQuietBits = 1.15;

/// By how much each choice of a filter makes the estimate of lossy bits larger: by as much as it
/// was measured to lose (penaltyOf()). Larger numbers choose the filter less often.
constexpr double kPerLong = 0.01, kPerShort = 0.035, kPerSmooth = 0.03;
/// Bits a sample from which on filters are chosen at the step of a budget too. With a smaller
/// number the prefixes of budgets lose more than their ends gain: 4.5 % of the bytes.
constexpr double kManyBits = 3.5;

/// Appends the magnitudes of a part's details, times their norms unless `plain`. Zeros, which
/// flat ground consists of, cost nothing and say nothing about the step.
void appendDetails(const PlanePart& part, const WaveletHeader& header, bool plain,
                   std::vector<float>& details) {
  const WaveletSpec spec = specOf(header);
  std::vector<int32_t> plane = withFractions(part.values, header.fraction_bits);
  const std::vector<int32_t> areas = withFractions(part.area_values, header.fraction_bits);
  const PlaneLayout layout(spec, Pyramid(part.extent, part.valid, {part.held, areas}));
  forwardWavelet(spec, layout.pyramid(), plane);
  for (size_t i = 1; i < layout.subbands().size(); ++i) {
    const Subband& band = layout.subbands()[i];
    const auto norm = static_cast<float>(plain ? 1 : std::sqrt(layout.energy(i)));
    for (uint32_t row = 0; row < band.height; ++row) {
      const int32_t* from = plane.data() + layout.pyramid().indexOf(band, row);
      for (uint32_t column = 0; column < band.width; ++column) {
        if (from[column] != 0) details.push_back(norm * std::abs(static_cast<float>(from[column])));
      }
    }
  }
}

double samplesIn(const std::vector<PlanePart>& parts) {
  double count = 0;
  for (const PlanePart& part : parts)
    count += static_cast<double>(markedIn(part.extent, part.valid));
  return std::max(count, 1.0);
}

float stepOf(std::vector<float> details) {
  if (details.empty()) return 1;
  const auto nth = details.begin() +
                   static_cast<ptrdiff_t>(static_cast<double>(details.size()) * (1 - kSignificant));
  std::nth_element(details.begin(), nth, details.end());
  return std::max(*nth, 1.0f);
}

/// Sum of log2(1 + d / step): a logarithm for many details is much faster than one for each.
double bitsOf(const std::vector<float>& details, float step) {
  constexpr double kLarge = 1e200;  // another factor is below 1e40
  double bits = 0, product = 1;
  for (float d : details) {
    product *= 1 + d / step;
    if (product < kLarge) continue;
    bits += portable::log2(product);
    product = 1;
  }
  return bits + portable::log2(product);
}

/// The estimate counts bits, not what their errors add up to, which is more where a filter is
/// further from orthogonal: beside decoded results it favours kLong by about 1 % with each choice
/// of it, and kShort by more, the coarser the step is: kShort suits walls between flat ground and
/// flat roofs, which alone take clearly fewer bits by it. kSmooth suits smooth ground, whose errors
/// it makes up to ten times smaller; elsewhere it takes 2 to 3 % more bytes than the best.
double penaltyOf(const Filters& filters) {
  const auto choices = [&](uint8_t id) {
    return static_cast<double>(std::count(filters.begin(), filters.end(), id));
  };
  return 1 + kPerLong * choices(kL) + kPerShort * choices(kS) + kPerSmooth * choices(kN);
}

/// The bits, made larger by the penalty of the filters. A filter loses the same number of decibels
/// at every high rate, and six decibels are a bit a sample: from one bit a sample on the penalty
/// grows no further.
double penalised(double bits, const Filters& filters, double samples) {
  return bits + (penaltyOf(filters) - 1) * std::min(bits, samples);
}

/// A step that is finer than `usual`, and as fine as the target asks; `usual` if it does not, or if
/// it has few bits, whose prefixes would lose more than its end gains.
float finerStep(const std::vector<float>& details, float usual, double unit, double samples,
                const RateTarget& target) {
  if (target.mean_square > 0)
    return std::min(usual, static_cast<float>(unit * std::sqrt(12 * target.mean_square)));
  float step = usual;
  while (target.bits >= kManyBits && step > 1 && bitsOf(details, step / 2) <= target.bits * samples)
    step /= 2;
  return step;
}

/// A choice, and about how many bits the details of the parts take.
struct Choice {
  WaveletHeader header;
  double bits = 0, penalised = std::numeric_limits<double>::infinity();
};

/// bits: those of the estimate, which is compared after it was multiplied by the penalty.
void keepIfBetter(const WaveletHeader& header, double bits, double penalty, Choice& best) {
  if (bits * penalty < best.penalised) best = {header, bits, bits * penalty};
}

WaveletHeader headerWith(const Filters& filters, int fraction_bits, int bits) {
  WaveletHeader header{filters, 0, 0, kLateDoubled, 0};
  header.fraction_bits = static_cast<uint8_t>(fraction_bits);
  header.bits = static_cast<uint8_t>(bits + fraction_bits);
  return header;
}

Choice chooseLossy(const std::vector<PlanePart>& parts, int bits, const RateTarget& target) {
  const double samples = samplesIn(parts);
  Choice best;
  float usual = 0, finer = 0;
  for (const Filters& filters : kLossyChoices) {
    if (filters.back() == kO && bits > kGrowingBits) continue;
    const WaveletHeader header =
        headerWith(filters, std::clamp(kBitsWithFractions - bits, 0, kMostFractionBits), bits);
    std::vector<float> details;
    for (const PlanePart& part : parts) appendDetails(part, header, false, details);
    if (usual == 0) {
      usual = stepOf(details);
      finer = finerStep(details, usual, portable::exp2(header.fraction_bits), samples, target);
    }
    const double bits_usual = penalised(bitsOf(details, usual), filters, samples);
    const double bits_finer =
        finer < usual ? penalised(bitsOf(details, finer), filters, samples) : bits_usual;
    keepIfBetter(header, std::sqrt(bits_usual * bits_finer), 1, best);
  }
  if (best.header.fraction_bits > 0) best.header.first_doubled = 0;
  return best;
}

Choice chooseLossless(const std::vector<PlanePart>& parts, int bits,
                      std::span<const LosslessChoice> choices) {
  Choice best;
  for (const auto& [filters, penalty] : choices) {
    if (filters.back() == kQ && bits > kGrowingBits) continue;
    const WaveletHeader header = headerWith(filters, 0, bits);
    std::vector<float> details;
    for (const PlanePart& part : parts) appendDetails(part, header, true, details);
    keepIfBetter(header, bitsOf(details, 1), penalty, best);
  }
  const bool quiet = best.header.filters.back() == kQ;
  if (best.bits < (quiet ? kFewQuietBits : kFewBits) * samplesIn(parts)) {
    best.header.first_doubled = kEarlyDoubled;
    // Level 2 is then lifted jointly, and rounds each coefficient once.
    if (quiet) best.header.filters[1] = kL;
  }
  return best;
}

/// Chooses for heights, and for textures that are not for the last bit.
Choice chooseAmong(const std::vector<PlanePart>& parts, int bits, Purpose purpose,
                   const RateTarget& target = {}) {
  if (purpose == Purpose::kLossy) return chooseLossy(parts, bits, target);
  return chooseLossless(parts, bits, kLosslessHeights);
}

}  // namespace

WaveletHeader chooseWavelet(const PlaneView<const int32_t>& plane, int bits, Purpose purpose,
                            const RateTarget& target) {
  return chooseAmong(typicalPartsOf(std::span(&plane, 1)), bits, purpose, target).header;
}

WaveletHeader chooseWavelet(const PlaneView<const int32_t>& plane, const HeldSamples& held,
                            int bits, Purpose purpose, const RateTarget& target) {
  return chooseAmong(typicalPartsOf(std::span(&plane, 1), held), bits, purpose, target).header;
}

WaveletHeader chooseLosslessWavelet(std::span<const PlaneView<const int32_t>> planes, int bits) {
  return chooseLossless(typicalPartsOf(planes), bits, kLosslessImages).header;
}

bool suitsSmoothGround(const WaveletHeader& chosen) {
  return chosen.filters.front() == kN;
}

WaveletHeader withShortReach(WaveletHeader chosen) {
  chosen.filters.back() = kS;
  return chosen;
}

WaveletHeader withoutFraction(WaveletHeader lossy) {
  lossy.bits = static_cast<uint8_t>(lossy.bits - lossy.fraction_bits);
  lossy.fraction_bits = 0;
  lossy.first_doubled = kLateDoubled;
  return lossy;
}

double losslessBits(const PlaneView<const int32_t>& plane, int bits) {
  const std::vector<PlanePart> parts = typicalPartsOf(std::span(&plane, 1));
  const double whole =
      static_cast<double>(markedIn(plane.extent(), plane.valid)) / samplesIn(parts);
  return chooseAmong(parts, bits, Purpose::kLossless).bits * whole;
}

}  // namespace tetrakis::inline choice
