// SPDX-License-Identifier: Apache-2.0
// toSteps() turns samples of any type into integer steps: it chooses base and step for the error
// that the target allows. nearGrid() and fewerBitsByOtherSteps() offer other steps, which show the
// samples nearly, or some of them, in fewer bits. Encoder only.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "base/plane.hpp"
#include "base/portable_math.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "tetrakis/result.hpp"
#include "tetrakis/tetrakis.h"

namespace tetrakis::inline quantiser {

// bitsOfSteps() and exactBits() estimate the number of bits that heights take to the last bit.

/// Corrections of samples: how many are not 0, and the bits that their magnitudes take.
struct Exceptions {
  size_t count = 0;
  double magnitude_bits = 0;

  void add(uint32_t correction, size_t samples) {
    const auto signed_one = static_cast<double>(static_cast<int32_t>(correction));
    count += samples;
    magnitude_bits += static_cast<double>(samples) * (1 + portable::log2(1 + std::abs(signed_one)));
  }
  /// The bits of the corrections that are not 0, and of their places among all samples.
  double bits(size_t samples) const {
    const double share = static_cast<double>(count) / static_cast<double>(samples);
    if (count == 0 || count == samples) return magnitude_bits;
    const double entropy = -share * portable::log2(share) - (1 - share) * portable::log2(1 - share);
    return magnitude_bits + static_cast<double>(samples) * entropy;
  }
};

/// The bits of the coefficients of steps, without the corrections that restore samples behind them.
double bitsOfSteps(const tks_heights& heights, const HeightSteps& steps);

/// The bits of the steps, multiples of `step`, and of the corrections that restore the samples.
double exactBits(const tks_heights& heights, const HeightSteps& steps);

// nearGrid() finds the common unit near whose multiples floats lie, though not on them: whole
// metres that a program has shifted by a rounding of its own, feet that were written with three
// decimals. Within a largest error the multiples will do.

/// The widest common unit, beyond 2 * error, that has a multiple within the error of every valid
/// sample. heights: of floats.
std::optional<double> nearGrid(const tks_heights& heights, Mask valid, double error);

// toSteps() turns heights of any sample type into integer steps, sample = base + q * step: it finds
// the base and the step of all samples. A few samples off that grid (a negative zero, one
// interpolated height, an undeclared void of 3.4e38) are left to corrections, so that they do not
// make every step finer.

/// The most steps that the range of heights is divided into.
inline constexpr double kMostSteps = 1 << 26;
/// Parts of the range that the steps of lossy streams divide it into: finer than any of them
/// resolves. With a larger number heights are too wide for the filter kOrthogonal.
inline constexpr double kLossySteps = 1 << 20;
/// The decimal steps that are tried, in units of the samples. More of them take the time of a pass
/// over the samples each.
inline constexpr std::array<double, 4> kDecimalSteps = {1.0, 0.1, 0.01, 0.001};

/// The demands of the target on the steps that are chosen.
struct StepNeeds {
  double given = 0;       ///< > 0: the step itself, in sample units; nothing is chosen
  bool lossless = false;  ///< corrections will restore the samples
  bool table = false;     ///< for `lossless`: a table of values may take the place of multiples
  double error = 0;       ///< > 0: largest error wanted, in sample units
  /// A few samples may be lost that are so far from the others that no steps show both; for
  /// `lossless` corrections restore them.
  bool leave_outliers = false;
};

/// Chooses base and step. Integers get the greatest common divisor of their differences, doubled
/// until 2^26 steps suffice; floats the coarsest of 1, 0.1, 0.01, 0.001 or a power of two that
/// restores the value of every sample, or of all but one in 256 where these may be exceptions.
/// Where no step does that within 2^26 steps: for lossless sixteen times the spacing of the largest
/// floats (corrections do the rest); else a power of two near range / 2^20, but not above error /
/// 64 unless that takes more than 2^26 steps. TKS_USAGE: a sample is infinite, or the given step
/// needs more than 2^26 steps.
Result<HeightSteps> toSteps(const tks_heights& heights, const StepNeeds& needs);

// fewerBitsByOtherSteps() tries a coarser and a finer step than the one that shows all samples.
// Files that join several sources have samples of whole metres, or decimetres, beside any others: a
// step that shows all samples codes bits that the whole ones do not have. A coarser step shows the
// whole ones, and corrections restore the others. Floats that are smooth to their last bits, which
// no step shows, take fewer bits as coefficients of a finer step than as corrections.

/// found: the steps of toSteps(), with corrections behind them where they are not exact. Returns
/// these steps, or coarser or finer ones that by the estimate clearly take fewer bits.
HeightSteps fewerBitsByOtherSteps(const tks_heights& heights, HeightSteps found);

}  // namespace tetrakis::inline quantiser
