// SPDX-License-Identifier: Apache-2.0
// QuantisedHeights is the input heights as integer steps, with the layers that do not depend on how
// the coefficients are coded: the validity mask, a table of values, and the corrections that
// restore samples which no steps show. quantiseHeights() makes it. Every attempt to code the
// heights starts from such a value and leaves it as it is.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/status.hpp"
#include "bitstream/stream/header.hpp"
#include "codec/geometry/corrections/correction_parts.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "encoder/heights/late_mask.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline heights {

/// The RMSE of the cut, in relative steps. Finer ones code what samples do not have, coarser ones
/// miss more of the multiples.
inline constexpr double kRelativeCut = 0.3;

struct QuantisedHeights {
  /// The least error of samples that are not exact: -0 in the place of 0 is no distance, but wrong.
  static constexpr double kInexact = 1e-200;

  const tks_heights* samples = nullptr;  ///< the input, which outlives this
  HeightSteps steps;
  GeometryLayers layers;               ///< the bytes of coefficients are not known yet
  std::vector<uint8_t> validity = {};  ///< codeword; empty: all samples are valid
  LateMask late = {};                  ///< in its place, where there are coefficients
  std::vector<uint8_t> table = {};     ///< codeword; empty: steps are multiples
  PartCodewords corrections = {};      ///< of each part of the plane; restore the samples
  /// Squared error that complete steps leave in the samples, in steps, until corrections of the
  /// samples are complete.
  double left = 0;
  /// How many samples of the whole heights show each one, if lines repeat; outlives this.
  std::span<const uint32_t> shown_by = {};
  double without_table = 0;  ///< squared error, in steps, of complete coefficients without it

  /// Corrections restore every sample.
  bool restored() const { return layers.restoresSamples(); }

  /// The samples that flat areas may have, as decoders know them ahead of the coefficients.
  Mask mayBeFlat() const { return late.none() ? steps.valid : steps.lifted; }

  /// Samples that count in the error; at least 1.
  double counted() const;

  /// So few samples that estimates of them are often wrong, and all ways to code them can be tried.
  bool isSmall() const { return extentOf(*samples).samples() <= 1 << 14; }

  /// What a sample costs whose validity is not yet known rightly, in squared steps: as much as a
  /// height that is off by a quarter of their range.
  double validityWorth() const;

  /// Squared error, in steps, that a sample counts at most: four times the squared range. An
  /// exception of the steps may be off by 1e38, beside which nothing else would count.
  double mostOfASample() const;

  /// Squared error of such steps, in steps.
  double squaresOf(const HeightSteps& other) const;

  /// Squared error, in steps, of what is decoded from a prefix, over the samples that `valid` says.
  /// Samples that are shown more often than in the mean count more. Where steps are multiples,
  /// corrections are left out: they come all at once, behind all else.
  double squaresOf(DecodedHeights decoded, const std::vector<uint8_t>& valid) const;
};

/// TKS_USAGE: a sample is infinite, or the step that is given does not suffice. inputs: with
/// heights.
Result<std::shared_ptr<const QuantisedHeights>> quantiseHeights(const EncodeInputs& inputs);

/// The same in multiples of a step, whatever a table of the values would do.
Result<std::shared_ptr<const QuantisedHeights>> quantiseInMultiples(const EncodeInputs& inputs);

/// The relative step of the samples (codec/geometry/relative/), in their units; 0: there is none,
/// or the steps are exact and not much finer.
double relativeStepOf(const QuantisedHeights& heights);

/// The heights in steps that are fine beside a relative step, which restores the samples that they
/// do not show; null if no such steps suffice.
std::shared_ptr<const QuantisedHeights> quantiseForRelative(const EncodeInputs& inputs,
                                                            double relative_step);

/// The heights in steps for facets, which restore the samples; null if no steps suffice.
std::shared_ptr<const QuantisedHeights> quantiseForFacets(const EncodeInputs& inputs);

/// What restores the samples behind steps.
struct SampleCorrections {
  PartCodewords codewords;
  double left;  ///< QuantisedHeights::left
};

/// shown: what decoders make of all coefficients, in steps of these heights. region_log2: of the
/// coefficients. threads: nothing depends on them.
SampleCorrections correctionsBehind(const QuantisedHeights& heights, const HeightSteps& shown,
                                    int region_log2, uint32_t threads);

QuantisedHeights withCorrections(QuantisedHeights heights, SampleCorrections corrections);

/// What the header says of the heights before their coefficients are coded.
GeometryHeader headerOf(const QuantisedHeights& heights);

}  // namespace tetrakis::inline heights
