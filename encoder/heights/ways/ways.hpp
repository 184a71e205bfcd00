// SPDX-License-Identifier: Apache-2.0
// A way takes quantised heights, or heights that are coded with loss, and returns coded heights
// that are exact or keep an error. codeHeightsForTarget() chooses the ways for the target of the
// options and keeps the shortest result, because no single way is the shortest for all terrains.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "codec/geometry/facets/facets_encoder.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"

namespace tetrakis::inline ways {

// codeRestored() appends corrections of the samples to lossy heights, so that the complete stream
// is exact and all prefixes stay as they are. It serves samples that are on no grid of steps (most
// floats, and integers of a wide range): lossy heights count coarse steps for such samples, and
// would end with an error however large the budget is.

/// Whether lossy heights can be followed by corrections of the samples: they are coded whole, and
/// are no lossless heights yet.
bool canBeRestored(const CodedHeights& lossy);

/// The heights with their coefficients as they are and the corrections behind them. lossy:
/// canBeRestored().
CodedHeights codeRestored(const EncodeInputs& inputs, const CodedHeights& lossy);

// cutAt() and codeUpTo() end the coefficients of heights, in one track or in many, where a given
// squared error is reached. Corrections follow such a cut (encoder/heights/coded_heights.hpp).

/// The heights cut where their squared error falls to `squares`, in steps: of all tracks the bytes
/// remain that take off most error. Nothing if the heights do not reach this error. whole: without
/// corrections.
std::optional<CodedHeights> cutAt(const CodedHeights& whole, double squares);

/// Lossy heights coded up to a mean squared error, in steps; whole if they do not reach it.
CodedHeights codeUpTo(const EncodeInputs& inputs, std::shared_ptr<const QuantisedHeights> quantised,
                      double mean_square);

// codeFacets() codes floats of a surface that consists of facets (codec/geometry/facets/): it cuts
// the coefficients, and codes how each sample goes on from its neighbours.

/// The facets of heights, if they hold enough of the samples.
std::optional<FacetShare> facetsOf(const QuantisedHeights& heights);

/// Whether heights with these facets may take at most `bytes` bytes.
bool mayFit(const FacetShare& facets, const QuantisedHeights& heights, uint64_t bytes);

/// Codes heights to the last bit, in any number of tracks; nothing if no steps come near the
/// samples. facets: of the samples.
std::optional<CodedHeights> codeFacets(const EncodeInputs& inputs, const FacetShare& facets);

/// The facets of lossy heights, if corrections from them may follow a cut of the heights in `bytes`
/// bytes together.
std::optional<FacetShare> facetsOf(const CodedHeights& lossy, uint64_t room);

/// Lossy heights, cut where they leave room, within `bytes` bytes, for the corrections that restore
/// their samples. Prefixes up to the cut are those of the lossy heights. Nothing if there is no
/// such cut. facets: facetsOf() the lossy heights.
std::optional<CodedHeights> codeFacets(const CodedHeights& lossy, const FacetShare& facets,
                                       uint64_t room, uint32_t threads);

// codeRelative() codes samples that have a relative step (codec/geometry/relative/). No grid of
// steps shows them, and yet few bits restore them: the coefficients are cut at a part of the
// relative step, and corrections follow.

/// The relative step of the samples of lossy heights, if corrections from it can follow a cut of
/// the heights; 0: there is none.
double relativeStepOf(const CodedHeights& lossy);

/// The lossy heights cut, with corrections behind them; nothing if they do not reach the cut.
/// relative_step: positive, from relativeStepOf().
std::optional<CodedHeights> codeRelative(const CodedHeights& lossy, double relative_step,
                                         uint32_t threads);

/// Codes heights to the last bit, in any number of tracks. quantised: from quantiseForRelative().
CodedHeights codeRelative(const EncodeInputs& inputs,
                          const std::shared_ptr<const QuantisedHeights>& quantised,
                          double relative_step);

// codeCorrected() cuts the coefficients of heights and adds corrections for every sample that is
// then off by more than a largest error, which may be 0. Near a bound this takes fewer bytes than
// coding the last bit-planes, which are mostly noise
// (codec/geometry/coding_choice/cuts.hpp).

/// Heights that can be cut and corrected.
struct Correctable {
  std::shared_ptr<const QuantisedHeights> quantised;  ///< without corrections
  Purpose purpose;                                    ///< of the coefficients
  CoefficientOptions options;
  int32_t largest = 0;  ///< error, in steps, that corrections leave
};

/// The cut that is wanted.
struct CutTarget {
  std::optional<double> mean_square = {};  ///< that it leaves, in steps; nothing: fewest bytes
  uint64_t rival = UINT64_MAX;             ///< heights that clearly take more bytes are of no use
};

/// Codes heights with corrections, beside the flat areas and with the filters that suit the cut. If
/// no sample is off, there are no corrections.
CodedHeights codeCorrected(const Correctable& heights, const CutTarget& target);

/// Lossy heights cut at an RMSE, in steps, with corrections of all samples that are still off.
/// Prefixes up to the cut are those of the lossy heights, and the end is exact. Nothing if heights
/// in regions do not reach this RMSE. lossy: of exact steps without a table.
std::optional<CodedHeights> codeCorrected(const EncodeInputs& inputs, const CodedHeights& lossy,
                                          double rmse);

/// The RMSE, in steps, of a cut that by the estimate takes, with its corrections, far fewer than
/// `bytes` bytes; nothing if there is none. lossy: of exact steps without a table.
std::optional<double> farShorterCut(const CodedHeights& lossy, uint64_t bytes);

// exactHeightsFor() codes heights to the last bit for a target that does not ask for the last bit,
// where exact heights may take fewer bytes than inexact ones: the last bit-planes of lossy
// coefficients are noise, and lossy coding knows nothing of tables of values and drawings, which
// suit heights of few values.

/// Whether exact heights may take at most `bytes` bytes to the last bit, by typical parts; if not,
/// what these foretell is noted.
bool mayTakeNoMore(const EncodeInputs& inputs, const QuantisedHeights& heights, uint64_t bytes);

/// The heights that the target `lossless` would give. error: the largest or mean error, in sample
/// units, that the target of the inputs allows; lossy_bytes: bytes of lossy heights of this error.
/// Null where the error is so large that exact heights cannot pay, unless they have few values: a
/// table, or a drawing that may fit.
std::shared_ptr<const CodedHeights> exactHeightsFor(const EncodeInputs& inputs, double error,
                                                    uint64_t lossy_bytes);

// codeLosslessHeights() codes heights to the last bit in the way that takes the fewest bytes:
// coefficients without fraction bits; a cut of lossy coefficients with corrections behind it (of
// steps, from a relative step, or of facets); or a drawing.

/// Codes every step exactly in the way that takes the fewest bytes: coefficients, corrections
/// behind a cut, or a drawing. Steps need not restore samples: those of a largest error do not.
std::shared_ptr<const CodedHeights> codeEveryStep(
    const EncodeInputs& inputs, const std::shared_ptr<const QuantisedHeights>& quantised);

/// quantised: from quantiseHeights(inputs).
std::shared_ptr<const CodedHeights> codeLosslessHeights(
    const EncodeInputs& inputs, const std::shared_ptr<const QuantisedHeights>& quantised);

// codeBoundedHeights() codes heights so that no sample is off by more than the largest error e, in
// steps, that the options allow. It tries two ways and keeps the one of fewer bytes:
//
//   round     heights become multiples of 2 e + 1 steps (floats of twice the bound) and are coded
//             to the last bit. This is best where e is near the noise of the heights.
//   correct   the coefficients are cut, and what then is off by more than e gets a correction in
//             multiples of 2 e + 1. This is best where e is larger than the noise: with 5 m
//             on mountains it takes half the bytes of rounding.
//
// Cutting so late that nothing is off by more than e takes up to twice the bytes of either.

/// quantised: from quantiseHeights(inputs). inputs: with a max_error.
std::shared_ptr<const CodedHeights> codeBoundedHeights(
    const EncodeInputs& inputs, std::shared_ptr<const QuantisedHeights> quantised);

// codeHeightsForTarget() codes quantised heights in the way that the target of the options asks
// for: this is where the branches for bytes, a PSNR, a largest error and lossless begin
// (docs/ARCHITECTURE.md, "How heights are coded").

/// quantised: from quantiseHeights(inputs).
std::shared_ptr<const CodedHeights> codeHeightsForTarget(
    const EncodeInputs& inputs, std::shared_ptr<const QuantisedHeights> quantised);

}  // namespace tetrakis::inline ways
