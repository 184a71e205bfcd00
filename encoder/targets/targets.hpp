// SPDX-License-Identifier: Apache-2.0
// meetTarget() takes the coded heights and texture and returns the packets of both that meet the
// target of the options. It compares them with candidates that are coded in other ways, which the
// other functions of this file make: the first coding of a component is not always the best one for
// the target.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "encoder/heights/coded_heights.hpp"
#include "encoder/heights/ways/ways.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/selection/write_stream.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "ratecontrol/allocation/allocation.hpp"
#include "ratecontrol/curves/component_curve.hpp"
#include "ratecontrol/needs/needs.hpp"
#include "tetrakis/result.hpp"

namespace tetrakis::inline targets {

// curveOfHeights() and curveOfTexture() find out how far the bytes of a coded component lower its
// errors. They tell ratecontrol/curves/, which knows no samples, how to decode and measure a
// prefix.

ComponentCurve curveOfHeights(const EncodeInputs& inputs, const CodedHeights& heights);

ComponentCurve curveOfTexture(const EncodeInputs& inputs, const CodedTexture& texture);

// Candidates are the attempts at both components from which a target selects. withCurves() gives
// them their curves and orderPackets() orders their packets; codeLossless() and storedIfShorter()
// make the attempts that follow the first one.

using HeightsCandidate = Candidate<CodedHeights>;
using TextureCandidate = Candidate<CodedTexture>;

/// `coded` is null where the stream has no such component.
struct Candidates {
  HeightsCandidate heights;
  TextureCandidate texture;
  std::shared_ptr<const PairErrors> errors = {};  ///< of both; null where there is but one
};

/// RMSE in steps, or texel units, below which the last bit is worth a try. A larger number takes
/// the time of more trials; with a smaller one budgets end before the last bit that could hold it.
inline constexpr double kNearlyExact = 0.6;

/// The candidates with the curves of both components and with the errors that viewers see: those
/// that are known already, or else those measured for these candidates.
Candidates withCurves(const EncodeInputs& inputs, Candidates candidates);

/// All packets of both components, which have curves, in their joint order.
Selection orderPackets(const Candidates& candidates);

/// The quality that a component states after the first bytes of its packets. The candidate has a
/// curve.
uint8_t qualityAfter(const EncodeInputs& inputs, const HeightsCandidate& heights, uint64_t bytes);
uint8_t qualityAfter(const EncodeInputs& inputs, const TextureCandidate& texture, uint64_t bytes);

/// Whether coding without fraction bits restores every sample and has not been done already.
bool hasLosslessWay(const CodedHeights& heights);
bool hasLosslessWay(const CodedTexture& texture);

/// Codes the component without fraction bits, which is the cheaper way to the last bit.
/// hasLosslessWay() holds.
HeightsCandidate codeLossless(const EncodeInputs& inputs, const CodedHeights& heights);
TextureCandidate codeLossless(const EncodeInputs& inputs, const CodedTexture& texture);

/// The candidate itself, or the samples stored without coding where these take fewer bytes, as
/// noise does.
HeightsCandidate storedIfShorter(const EncodeInputs& inputs, HeightsCandidate heights);
TextureCandidate storedIfShorter(const EncodeInputs& inputs, TextureCandidate texture);

// heightsNeed() finds the number of bytes of coded heights that reaches the PSNR of the options.

/// The first bytes of the heights' packets that reach the PSNR; nothing where none do. The PSNR is
/// reached only when the place of the voids is known. heights: with a curve.
std::optional<uint64_t> heightsNeed(const EncodeInputs& inputs, const HeightsCandidate& heights);

// fewValues() and shortExactHeights() make exact heights for a byte budget by means that lossy
// heights do not have: drawings, tables of values, and corrections from neighbours.

/// Heights of few values to the last bit, of which the budget holds a large part. Lossy heights
/// have no drawings and no tables of values, and may never come as near.
struct HeightsOfFewValues {
  HeightsCandidate heights;  ///< with their curve; `coded` is null: there are none
  bool fit = false;          ///< see fewValues()
};

/// Codes heights of few values. `fit` says that they are taken even if prefixes lose by it: a table
/// has to save half of the budget for that; a drawing, or corrections in the place of a table, have
/// saved enough in any case.
HeightsOfFewValues fewValues(const EncodeInputs& inputs, const HeightsCandidate& lossy);

/// Whether the part of the exact heights that the budget holds is nearer to the samples than its
/// part of the lossy ones. Both have curves. room: bytes for packets.
bool isNearer(const EncodeInputs& inputs, const HeightsCandidate& exact,
              const HeightsCandidate& lossy, uint64_t room);

/// The shortest heights to the last bit, if they take clearly less than the budget; else `coded` is
/// null. Their prefixes are those of lossless heights, so they serve budgets in which no other
/// heights are exact. few: from fewValues(), which need no second coding.
HeightsCandidate shortExactHeights(const EncodeInputs& inputs, const HeightsCandidate& lossy,
                                   const HeightsCandidate& few);

// exactHeights(), exactTexture() and exactWays() make candidates of one component that end exact
// within a byte budget, to be held against the lossy candidate that the encoder makes first.

/// The ways in which neighbours restore samples that are on no grid of steps.
struct ByNeighbours {
  double relative_step = 0;  ///< in sample units; 0: none
  std::optional<FacetShare> facets = {};

  /// lossy: the heights, if there are any. room: bytes for them.
  ByNeighbours(const HeightsCandidate& lossy, uint64_t room);
};

/// The heights to the last bit in fewer than `room` bytes, if their prefixes are as good as those
/// of the lossy heights. Where samples are on no grid, the way of fewer bytes is taken.
std::optional<HeightsCandidate> exactHeights(const EncodeInputs& inputs,
                                             const HeightsCandidate& lossy,
                                             const ByNeighbours& neighbours, uint64_t room);

/// The texture to the last bit, under the same conditions. Drawn and stored textures are lossless
/// as they stand, but tables of values may take fewer bytes; where these leave half of the budget,
/// prefixes do not matter.
std::optional<TextureCandidate> exactTexture(const EncodeInputs& inputs,
                                             const TextureCandidate& lossy, uint64_t room);

/// All ways to code heights to the last bit in fewer bytes than the budget whose prefixes are as
/// good as those of the lossy heights, which have a curve. Coefficients of a cut are those of the
/// lossy heights, unless only the lossless way fits.
std::vector<HeightsCandidate> exactWays(const EncodeInputs& inputs, const HeightsCandidate& lossy,
                                        const ByNeighbours& neighbours);

// exactWithinBudget() tries heights and texture to the last bit where a byte budget comes near to
// it: the last bit-planes of lossy coefficients can take more bytes than exact samples do. It tries
// both components, then the heights alone, beside the lossy candidates, and holds the pictures of
// their prefixes against each other: exact heights are taken if the picture is better with the
// whole budget, by more decibels than it loses with 1/16 to 3/4 of the budget together.

/// All packets of components that end exact. Both components are exact if they fit the budget and
/// prefixes lose nothing. Else the heights are exact if the cameras see fewer errors for it or,
/// without a texture, if the shortest exact heights take clearly less than the budget, or are of
/// few values and nearer than lossy ones as far as the budget holds them. Nothing if no exact
/// component pays. lossy: with curves; selection: the packets chosen of them.
std::optional<Selection> exactWithinBudget(const EncodeInputs& inputs, const Candidates& lossy,
                                           const Selection& selection);

// meetTarget() takes the coded components and returns the packets of both that meet the target of
// the options. Where the target lies next to the last bit, or where coding saves no bytes, it codes
// a component in another way as well and takes the way of fewer bytes.

/// heights, texture: null where the stream has none; coded for the target. TKS_USAGE: the PSNR is
/// higher than the step of the heights allows.
Result<Selection> meetTarget(const EncodeInputs& inputs,
                             std::shared_ptr<const CodedHeights> heights,
                             std::shared_ptr<const CodedTexture> texture);

}  // namespace tetrakis::inline targets
