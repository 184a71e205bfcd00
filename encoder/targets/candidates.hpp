// SPDX-License-Identifier: Apache-2.0
// Candidates are the attempts at both components from which a target selects. The functions here
// give candidates their curves, order their packets, and make the attempts that follow the first
// one: lossless coding, and stored samples.
#pragma once

#include <cstdint>
#include <memory>

#include "encoder/heights/coded_heights.hpp"
#include "encoder/inputs/encode_inputs.hpp"
#include "encoder/selection/selection.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "ratecontrol/allocation/pair_errors.hpp"
#include "ratecontrol/needs/candidate.hpp"

namespace tetrakis::inline targets {

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

}  // namespace tetrakis::inline targets
