// SPDX-License-Identifier: Apache-2.0
// QuantisedHeights is the input heights in integer steps, with everything that is settled before
// coefficients are coded: the lines that are coded, the options, base and step or a table of
// values, and the place of the mask of valid samples. Every way to code heights starts from it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/plane.hpp"
#include "bitstream/stream/header.hpp"
#include "bitstream/track/track_encoder.hpp"
#include "codec/geometry/corrections/corrections_encoder.hpp"
#include "codec/geometry/heights_encoder.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/geometry/steps/decoded_heights.hpp"
#include "codec/wavelet/choice/bridge_choice.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline heights {

// lateMaskOf() and placeOfMask() decide whether the mask of valid samples lies behind some of the
// coefficients, and behind how many. A mask of many single holes takes as many bytes as the
// heights: half of the samples void at random cost one bit a sample. Where such voids are bridged
// the coefficients depend only on the samples that are lifted, often all samples. So coefficients
// can come first, and until the mask is there bridged voids are shown as ground. Half or more of
// every prefix are coefficients, and the mask is whole after twice its bytes: neither comes later
// than twice as late as it could. A byte budget may bring the mask earlier, but leaves the
// coefficients a third of its bytes, or else leaves the mask out.

/// The codewords of a late mask.
struct LateMask {
  std::vector<uint8_t> lifted;    ///< which samples are lifted; empty: all
  std::vector<uint8_t> validity;  ///< which of these are valid; empty: the mask comes first

  bool none() const { return validity.empty(); }
  uint64_t bytes() const { return lifted.size() + validity.size(); }
};

/// The late mask beside lifted samples; none if the mask is short, or if it takes more bytes than a
/// mask that comes first by more than a thousandth of the stream. Where a budget has no room for a
/// mask that comes first, so that bridges are needed, only the codeword of the lifted samples has
/// to be short: the mask itself will be left out. target: that of the bridges.
LateMask lateMaskOf(const PlaneView<const uint8_t>& valid, Mask lifted, uint64_t first_bytes,
                    const BridgeTarget& target);

/// The limits of the coefficients before a late mask, within which a stream holds the mask.
struct MaskRoom {
  uint64_t bytes = UINT64_MAX;  ///< that coefficients before it may take at most
  uint64_t shared = 0;          ///< bytes for both
  double squares = 0;           ///< squared error that they may come down to
};

/// The room that a budget leaves for coefficients before a mask of `mask_bytes` bytes; nothing: the
/// budget has no room for the mask.
std::optional<uint64_t> roomBesideMask(uint64_t mask_bytes, uint64_t budget);

/// The part of bytes shared with a mask that coefficients get at least. With a smaller part a short
/// stream may hold the mask and hardly any heights.
uint64_t besideMaskAtLeast(uint64_t bytes);

struct MaskPlace {
  uint64_t after = 0;  ///< bytes of the first track's coefficients
  double worth = 0;    ///< squared error while it is missing: as much a byte as coefficients there
};

/// Where a mask of `bytes` bytes lies best: behind all coefficients if it would leave them too few
/// of the shared bytes, or of all bytes. coefficients: of all tracks.
MaskPlace placeOfMask(std::span<const EncodedTrack> coefficients, uint64_t bytes,
                      const MaskRoom& room);

// QuantisedHeights is the input heights as integer steps, with the layers that do not depend on how
// the coefficients are coded: the validity mask, a table of values, and the corrections that
// restore samples which no steps show. quantiseHeights() makes it. Every attempt to code the
// heights starts from such a value and leaves it as it is.

/// The RMSE of the cut, in relative steps. Finer cuts code digits that samples do not have, coarser
/// cuts miss more of the multiples.
inline constexpr double kRelativeCut = 0.3;

struct QuantisedHeights {
  /// The least error of samples that are not exact. A sample of -0 in the place of 0 has no
  /// distance from it, and is nevertheless wrong.
  static constexpr double kInexact = 1e-200;

  /// Fields of so few samples are small (isSmall()). A larger number saves bytes where estimates
  /// are wrong, and takes the time of all ways to code a field.
  static constexpr uint64_t kFewSamples = 1 << 14;

  const tks_heights* samples = nullptr;  ///< the input, which outlives this
  HeightSteps steps;
  GeometryLayers layers;               ///< the bytes of coefficients are not known yet
  std::vector<uint8_t> validity = {};  ///< codeword; empty: all samples are valid
  LateMask late = {};                  ///< in its place, where there are coefficients
  std::vector<uint8_t> table = {};     ///< codeword; empty: steps are multiples
  PartCodewords corrections = {};      ///< of each part of the plane; restore the samples
  /// Squared error, in steps, that the samples keep after all steps are decoded, until corrections
  /// of the samples are complete.
  double left = 0;
  /// The number of samples of the whole heights that each coded sample stands for, if lines repeat;
  /// outlives this.
  std::span<const uint32_t> shown_by = {};
  double without_table = 0;  ///< squared error, in steps, of complete coefficients without it
  SharedForest forest = {};  ///< that the samples are the raster of; null: of none

  /// Corrections restore every sample.
  bool restored() const { return layers.restoresSamples(); }

  /// The samples that flat areas may have, as decoders know them ahead of the coefficients.
  Mask mayBeFlat() const { return late.none() ? steps.valid : steps.lifted; }

  /// Samples that count in the error; at least 1.
  double counted() const;

  /// Whether there are so few samples that estimates are often wrong, and that all ways to code the
  /// heights can be tried.
  bool isSmall() const { return extentOf(*samples).samples() <= kFewSamples; }

  /// The squared error, in steps, of a sample whose validity is not decoded rightly yet: that of a
  /// height which is off by a quarter of the range.
  double validityWorth() const;

  /// The largest squared error, in steps, that one sample adds: four times the squared range. An
  /// exception of the steps may be off by 1e38, beside which no other sample would count.
  double mostOfASample() const;

  /// Squared error, in steps, of the samples that `other` restores.
  double squaresOf(const HeightSteps& other) const;

  /// Squared error, in steps, of the samples decoded from a prefix, over those that are valid.
  /// Samples that stand for more samples than the mean count more. Where steps are multiples,
  /// corrections are left out: they come last and at once.
  double squaresOf(DecodedHeights decoded, const std::vector<uint8_t>& valid) const;
};

/// TKS_USAGE: a sample is infinite, or the given step does not suffice. inputs: with heights.
Result<std::shared_ptr<const QuantisedHeights>> quantiseHeights(const EncodeInputs& inputs);

/// The same as quantiseHeights() in multiples of a step, even where a table of values takes fewer
/// bits.
Result<std::shared_ptr<const QuantisedHeights>> quantiseInMultiples(const EncodeInputs& inputs);

/// The relative step of the samples (codec/geometry/relative/), in their units; 0: there is none,
/// or the steps are exact and not much finer.
double relativeStepOf(const QuantisedHeights& heights);

/// The heights in steps that are fine beside a relative step. Corrections from the relative step
/// restore the samples that the steps do not show. Null if no steps suffice.
std::shared_ptr<const QuantisedHeights> quantiseForRelative(const EncodeInputs& inputs,
                                                            double relative_step);

/// The heights in steps for facets. Corrections from facets restore the samples. Null if no steps
/// suffice.
std::shared_ptr<const QuantisedHeights> quantiseForFacets(const EncodeInputs& inputs);

/// Corrections that restore the samples behind the steps.
struct SampleCorrections {
  PartCodewords codewords;
  double left;  ///< QuantisedHeights::left
};

/// shown: the steps of all coefficients, as a decoder computes them. region_log2: of the
/// coefficients. threads: nothing depends on them.
SampleCorrections correctionsBehind(const QuantisedHeights& heights, const HeightSteps& shown,
                                    int region_log2, uint32_t threads);

QuantisedHeights withCorrections(QuantisedHeights heights, SampleCorrections corrections);

/// The header of the heights before their coefficients are coded.
GeometryHeader headerOf(const QuantisedHeights& heights);

// heightOptions() makes the options for the coefficients of heights from the options of an
// encoding.

/// inputs: with heights.
CoefficientOptions heightOptions(const EncodeInputs& inputs);

// heightLines() finds the columns and rows of the input heights that repeat the one before them, so
// that only the other lines are coded (encoder/inputs/encode_inputs.hpp).

/// The lines of the heights to code; none where all are. A PSNR counts all samples, so for a PSNR
/// all lines are coded if runs differ clearly in length, or beside voids, where nobody knows by how
/// much a run counts.
CodedLines heightLines(const EncodeInputs& inputs);

}  // namespace tetrakis::inline heights
