// SPDX-License-Identifier: Apache-2.0
// An error of a band is worth its norm times the eye's sensitivity at the frequency of the band
// (W. Zeng, S. Daly, S. Lei 2000; ISO/IEC 15444-1, annex J.8), seen from so far that 64 samples
// make a degree: 3700 samples, 3.4 times the height of 1080 rows. From nearer the weights would be
// closer to 1.
//
// Luma: A(f) = 2.6 (0.0192 + 0.114 f) exp(-(0.114 f)^1.1), f in cycles per degree (J. L. Mannos,
// D. J. Sakrison 1974). Below its peak the weight stays 1, because whoever steps nearer sees coarse
// errors first. Colour differences: sensitivity falls exponentially from the lowest frequencies on
// (K. T. Mullen 1985); half of it is lost at 7.7 cycles.
#include "texture_wavelet/texture_encoder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/portable_math.hpp"

namespace tetrakis::inline texture {

namespace {

/// Samples that make a degree of sight. A larger number lets details weigh less, as from farther
/// away, and costs whoever steps nearer.
constexpr double kSamplesPerDegree = 64;
/// Levels that are weighed; coarser ones are seen as they are. More levels take bytes of the
/// header.
constexpr uint8_t kLevels = 6;
/// The frequency of the peak of luma, in cycles per degree. Lower ones weigh 1.
constexpr double kPeak = 8;
/// How fast the sensitivity to colour falls with the frequency. A larger number takes bytes from
/// details of colour for luma.
constexpr double kColourFall = 0.09;

double lumaSensitivity(double frequency) {
  const auto curve = [](double f) {
    return 2.6 * (0.0192 + 0.114 * f) * portable::exp(-portable::pow(0.114 * f, 1.1));
  };
  return frequency <= kPeak ? 1 : curve(frequency) / curve(kPeak);
}

double colourSensitivity(double frequency) {
  return portable::exp(-kColourFall * frequency);
}

/// The middle of a band: three quarters of the level's highest frequency, along both axes for HH.
double frequencyOf(int level, bool diagonal) {
  return 0.375 * kSamplesPerDegree / (1 << (level - 1)) * (diagonal ? std::numbers::sqrt2 : 1);
}

}  // namespace

BandWeights visualWeights(uint32_t planes) {
  BandWeights weights;
  weights.levels = kLevels;
  for (uint32_t c = 0; c < planes; ++c) {
    const bool colour = (c == 1 || c == 2) && planes >= 3;
    for (int level = 1; level <= kLevels; ++level) {
      for (const bool diagonal : {false, true}) {
        const double frequency = frequencyOf(level, diagonal);
        const double seen = colour ? colourSensitivity(frequency) : lumaSensitivity(frequency);
        weights.priority[c][static_cast<size_t>(2 * (level - 1) + diagonal)] =
            std::max<int64_t>(std::lround(16 * portable::log2(seen)), -BandWeights::kMaxPriority);
      }
    }
  }
  return weights;
}

}  // namespace tetrakis::inline texture
