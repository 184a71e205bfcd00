// SPDX-License-Identifier: Apache-2.0
// Heights of any sample type are coded as integer steps: sample = base + q * step. The functions
// here turn samples into steps and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/status.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "codec/geometry/height_layers.hpp"
#include "codec/geometry/value_table.hpp"

namespace tetrakis::inline geometry {

/// Returns the size of a height field of the C interface.
inline Extent extentOf(const tks_heights& heights) {
  return {heights.width, heights.height};
}

struct HeightSteps {
  std::vector<int32_t> steps;  ///< |q| <= 2^25, centred on 0; 0 where voids are
  std::vector<uint8_t> valid;  ///< 1 valid, 0 void; empty: all are valid
  double base = 0, step = 1;
  ValueTable table;    ///< not empty: steps count its values, which `base` and `step` approximate
  bool exact = false;  ///< every valid sample comes back bit for bit
  int range_bits = 0;  ///< the steps span less than 2^range_bits

  size_t validCount() const;
};

/// What the target asks of steps that are chosen.
struct StepNeeds {
  double given = 0;       ///< > 0: the step itself, in sample units; nothing is chosen
  bool lossless = false;  ///< corrections will restore the samples
  bool table = false;     ///< for `lossless`: a table of values may take the place of multiples
  double error = 0;       ///< > 0: largest error wanted, in sample units
  /// A few samples so far from the others that no steps show both may be lost; for `lossless`
  /// corrections restore them.
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

/// Writes samples of header.sample, one for each height of `decoded`; integers saturate at their
/// type's range. Voids become layers.nodata or NaN; a height that would be the declared nodata
/// value becomes the next sample, whether there are voids or not.
void fromSteps(const DecodedHeights& decoded, const GeometryHeader& header,
               const GeometryLayers& layers, void* out);

/// The hints (codec/geometry/corrections/corrections_pass.hpp) of corrections to samples that these
/// heights become, as decoders know them.
std::vector<uint8_t> sampleHints(std::span<const int32_t> heights, int fraction_bits,
                                 const GeometryHeader& header);

/// The steps of a table's values as decoders know them: drawn, and whole.
std::vector<int32_t> drawnSteps(const HeightSteps& steps, const GeometryHeader& header);

/// The corrections that restore the samples.
std::vector<int32_t> sampleCorrections(const tks_heights& heights, const HeightSteps& steps);

/// Largest distance between a valid sample and what its step becomes, and the sum of the squared
/// distances; in sample units.
struct StepErrors {
  double largest = 0, squares = 0;
};
/// How squared errors add up.
struct SquareSum {
  double most = std::numeric_limits<double>::infinity();  ///< what one sample adds at most
  std::span<const uint32_t> times = {};                   ///< how often each counts; empty: once
  double of(size_t sample, double error) const {
    const double square = std::min(error * error, most);
    return times.empty() ? square : times[sample] * square;
  }
};
StepErrors errorsOf(const tks_heights& heights, const HeightSteps& steps,
                    const SquareSum& sum = {});

/// The squared distances between decoded samples, corrections included, and the true ones, over the
/// samples that `valid` says (empty: all). scale: their base and step.
double squaresOfSamples(const tks_heights& truth, const DecodedHeights& decoded,
                        const std::vector<uint8_t>& valid, const HeightSteps& scale,
                        const SquareSum& sum);

}  // namespace tetrakis::inline geometry
