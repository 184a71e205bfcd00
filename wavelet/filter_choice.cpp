// SPDX-License-Identifier: Apache-2.0
// A coefficient c coded with a step T costs about log2(1 + |c| / T) bits, its norm counted in |c|.
// Of the sums over all details the smallest wins, those of kLong made larger. Against the best of
// the choices, found by coding with each, that loses up to 0.3 % of the bytes on nine aerial images
// and maps and on seven DEMs; without it, up to 2.5 %.
#include "wavelet/filter_choice.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "wavelet/band_plan.hpp"
#include "wavelet/typical_parts.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis::inline wavelet {

namespace {

using Filters = std::array<uint8_t, WaveletSpec::kChoices>;

constexpr auto kS = static_cast<uint8_t>(FilterId::kShort);
constexpr auto kM = static_cast<uint8_t>(FilterId::kSixTap);
constexpr auto kO = static_cast<uint8_t>(FilterId::kOrthogonal);
constexpr auto kL = static_cast<uint8_t>(FilterId::kLong);
constexpr std::array<Filters, 4> kLossyChoices = {
    {{kL, kL, kL}, {kL, kL, kO}, {kL, kO, kO}, {kO, kO, kO}}};
constexpr std::array<Filters, 3> kLosslessChoices = {{{kM, kM, kM}, {kL, kL, kL}, {kS, kS, kS}}};

constexpr double kSignificant =
    0.1;  // share of the other details that the step T leaves above itself
constexpr int kMostFractionBits = 4;
constexpr uint32_t kTrialSide = 96;
constexpr int kOrthogonalBits = 20;  // with more, the growing low bands of kOrthogonal pass 2^30

/// Doubling low bands after level 2 in the place of level 4 halves the roundings of levels 3 and 4,
/// and takes 1/16 of a bit a sample. That is worth it where few bits are lossless, because then
/// cuts come near to what roundings lose.
constexpr uint8_t kEarlyDoubled = 2, kLateDoubled = 3;
constexpr double kFewBits = 1.6;

struct Sample {
  Extent extent;
  std::vector<int32_t> values;
  std::vector<uint8_t> valid;  // empty: all
  std::vector<uint16_t> held;  // empty: none
  std::span<const int32_t> levels;
};

Sample sampleOf(const PlaneView<const int32_t>& plane, const HeldSamples& held,
                const Window& part) {
  const View view{0, part};
  Sample sample{part.extent(), cut(std::span<const int32_t>(plane.values()), plane.extent(), view),
                cut(plane.valid.bytes(), plane.extent(), view),
                cut(held.numbers, plane.extent(), view), held.values};
  clearUnmarked(std::span(sample.values), sample.valid);
  return sample;
}

/// Appends the magnitudes of a sample's details, times their norms unless `plain`. Zeros, which
/// flat ground consists of, cost nothing and say nothing about the step.
void appendDetails(const Sample& sample, const WaveletHeader& header, bool plain,
                   std::vector<float>& details) {
  const WaveletSpec spec = specOf(header);
  std::vector<int32_t> plane = sample.values, levels(sample.levels.begin(), sample.levels.end());
  for (std::vector<int32_t>* values : {&plane, &levels}) {
    for (int32_t& v : *values)
      v = static_cast<int32_t>(static_cast<uint32_t>(v) << header.fraction_bits);
  }
  const PlaneLayout layout(spec, sample.extent, sample.valid, {sample.held, levels});
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

double samplesIn(const std::vector<Sample>& samples) {
  double count = 0;
  for (const Sample& sample : samples)
    count += static_cast<double>(markedIn(sample.extent, sample.valid));
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
    bits += std::log2(product);
    product = 1;
  }
  return bits + std::log2(product);
}

/// The estimate counts bits, not what their errors add up to, which is more where a filter is
/// further from orthogonal: beside decoded results it favours kLong by about 1 % with each choice
/// of it.
double penaltyOf(const Filters& filters) {
  constexpr double kPerChoice = 0.01;
  return 1 + kPerChoice * static_cast<double>(std::count(filters.begin(), filters.end(), kL));
}

/// Cuts of lossless streams are worse the shorter the filter is. By the Bjontegaard rate they lose
/// 10 % with kShort and 2 % with kSixTap (eight images), which some bytes at the end are worth. The
/// estimate makes differences of bytes three to four times as large as they are.
double cutPenaltyOf(const Filters& filters) {
  return filters[0] == kS ? 1.02 : filters[0] == kM ? 1.004 : 1;
}

/// A choice, and about how many bits the details of the samples take.
struct Choice {
  WaveletHeader header;
  double bits = 0, penalised = std::numeric_limits<double>::infinity();
};

std::vector<Sample> samplesOf(std::span<const PlaneView<const int32_t>> planes,
                              const HeldSamples& held = {}) {
  assert(!planes.empty());
  std::vector<Sample> samples;
  const Mask valid = planes.front().valid;
  IsCoded is_coded;
  if (!valid.all() || !held.numbers.empty()) {
    is_coded = [&](size_t i) { return valid[i] && (held.numbers.empty() || held.numbers[i] == 0); };
  }
  for (const Window& part : typicalParts(planes.front().extent(), kTrialSide, is_coded)) {
    for (const PlaneView<const int32_t>& plane : planes)
      samples.push_back(sampleOf(plane, held, part));
  }
  return samples;
}

Choice chooseAmong(const std::vector<Sample>& samples, int bits, Purpose purpose) {
  const bool lossless = purpose == Purpose::kLossless;
  std::span<const Filters> choices = kLosslessChoices;
  if (!lossless) choices = std::span(kLossyChoices).first(bits > kOrthogonalBits ? 1 : 4);
  Choice best;
  float step = 0;
  for (const Filters& filters : choices) {
    WaveletHeader header{filters, 0, 0, kLateDoubled, 0};
    if (!lossless)
      header.fraction_bits = static_cast<uint8_t>(std::clamp(20 - bits, 0, kMostFractionBits));
    header.bits = static_cast<uint8_t>(bits + header.fraction_bits);
    std::vector<float> details;
    for (const Sample& sample : samples) appendDetails(sample, header, lossless, details);
    if (step == 0) step = lossless ? 1 : stepOf(details);
    const double estimate = bitsOf(details, step);
    const double penalised = estimate * (lossless ? cutPenaltyOf(filters) : penaltyOf(filters));
    if (penalised < best.penalised) best = {header, estimate, penalised};
  }
  if (lossless && best.bits < kFewBits * samplesIn(samples))
    best.header.first_doubled = kEarlyDoubled;
  if (best.header.fraction_bits > 0) best.header.first_doubled = 0;
  return best;
}

}  // namespace

WaveletHeader chooseWavelet(const PlaneView<const int32_t>& plane, int bits, Purpose purpose) {
  return chooseWavelet(std::span(&plane, 1), bits, purpose);
}

WaveletHeader chooseWavelet(const PlaneView<const int32_t>& plane, const HeldSamples& held,
                            int bits, Purpose purpose) {
  return chooseAmong(samplesOf(std::span(&plane, 1), held), bits, purpose).header;
}

WaveletHeader chooseWavelet(std::span<const PlaneView<const int32_t>> planes, int bits,
                            Purpose purpose) {
  return chooseAmong(samplesOf(planes), bits, purpose).header;
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

PlaneCost typicalCost(const PlaneView<const int32_t>& plane, int bits, double step) {
  const std::vector<Sample> samples = samplesOf(std::span(&plane, 1));
  const WaveletHeader header =
      chooseAmong(samples, bits, step == 0 ? Purpose::kLossless : Purpose::kLossy).header;
  const WaveletSpec spec = specOf(header);
  const double unit = std::exp2(header.fraction_bits);
  PlaneCost sum;
  for (const Sample& sample : samples) {
    std::vector<int32_t> values = sample.values;
    for (int32_t& v : values)
      v = static_cast<int32_t>(static_cast<uint32_t>(v) << header.fraction_bits);
    const PlaneLayout layout(spec, sample.extent, sample.valid, {});
    forwardWavelet(spec, layout.pyramid(), values);
    const PlaneCost cost = costOf(layout, values, step * unit);
    sum.bits += cost.bits;
    sum.squares += cost.squares / (unit * unit);
  }
  const double whole =
      static_cast<double>(markedIn(plane.extent(), plane.valid)) / samplesIn(samples);
  return {sum.bits * whole, sum.squares * whole};
}

double losslessBits(const PlaneView<const int32_t>& plane, int bits) {
  const std::vector<Sample> samples = samplesOf(std::span(&plane, 1));
  const double whole =
      static_cast<double>(markedIn(plane.extent(), plane.valid)) / samplesIn(samples);
  return chooseAmong(samples, bits, Purpose::kLossless).bits * whole;
}

}  // namespace tetrakis::inline wavelet
