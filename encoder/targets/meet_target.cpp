// SPDX-License-Identifier: Apache-2.0
// meetTarget() selects the packets that the target of the options needs. Beside heights that keep a
// largest error, for which nobody names a size, a texture gets the packets that are worth as much
// as those of the heights.
#include "encoder/targets/targets.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/portable_math.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "encoder/heights/coded_heights.hpp"
#include "encoder/heights/ways/ways.hpp"
#include "encoder/selection/write_stream.hpp"
#include "encoder/textures/coded_texture.hpp"
#include "ratecontrol/allocation/allocation.hpp"
#include "ratecontrol/needs/needs.hpp"

namespace tetrakis::inline targets {

// The slopes at the end of heights that were coded for a bound tell little: the last bits of a
// coarse step, and corrections, take hardly anything off the squared error, and heights that vary
// less than the bound take no bytes at all. So the packets are put in the order of heights coded
// for as good a PSNR, whose slopes fall steadily as their error does.

namespace {

constexpr double kLeastPsnr = 0.1, kMostPsnr = 300;  // dB; 0 is no target
/// Heights beside a bound are coded for this PSNR at least, in dB, so that there are packets to
/// order. A larger number takes time; with a smaller one a coarse bound leaves packets too few.
constexpr double kOrderedPsnr = 30;

/// The PSNR of heights. Exact samples are as good as errors spread evenly within half of the step
/// that all of them are multiples of.
double psnrOf(const EncodeInputs& inputs, const CodedHeights& heights) {
  const HeightSteps& steps = heights.quantised->steps;
  const double least = steps.exact ? steps.step * steps.step / 12 : 0;
  const double squares =
      sampleErrorsOf(heights, codewordsOf(heights.tracks), inputs.options.threads).mean_square;
  const SampleRange range = rangeOf(*inputs.heights, steps.valid);
  const double peak = range.high - range.low;
  const double psnr = 10 * portable::log10(peak * peak / std::max(squares, least));
  return peak > 0 ? std::clamp(psnr, kLeastPsnr, kMostPsnr) : kLeastPsnr;
}

/// Codes the heights for a PSNR of at least kOrderedPsnr, so that there are packets to order; null
/// where the step that the caller gave is too coarse for this PSNR.
std::shared_ptr<const CodedHeights> codeForPsnr(const EncodeInputs& inputs,
                                                tks_encode_options options) {
  options.psnr = std::max(options.psnr, kOrderedPsnr);
  const EncodeInputs to_psnr = inputs.with(options, inputs.priorities);
  const Result<std::shared_ptr<const QuantisedHeights>> quantised = quantiseHeights(to_psnr);
  return quantised.ok() ? codeHeightsForTarget(to_psnr, *quantised) : nullptr;
}

// textureBesideBound() decides how many bytes a texture gets beside heights that keep a largest
// error. The caller gives no size for the texture, so it gets the packets that are worth as much as
// the bytes that bring the heights within their bound.

/// The bytes of the texture's packets that are worth as much as the bytes that bring heights within
/// the largest error; all bytes if heights of one value take none. candidates: heights within that
/// error, and a texture with a curve.
uint64_t textureBesideBound(const EncodeInputs& inputs, const Candidates& candidates) {
  tks_encode_options options = inputs.options;
  options.max_error = 0;
  options.psnr = psnrOf(inputs, *candidates.heights.coded);
  EncodeInputs to_psnr = inputs.with(options, inputs.priorities);
  to_psnr.notes = nullptr;  // these heights are no candidates
  const std::shared_ptr<const CodedHeights> heights = codeForPsnr(to_psnr, options);
  if (!heights) return kAllBytes;
  const Candidates both = withCurves(to_psnr, {{heights}, candidates.texture});
  const uint64_t need = heightsNeed(to_psnr, both.heights).value_or(kAllBytes);
  return sentWith(orderPackets(both).packets, Component::kGeometry, need)[1];
}

/// The packets that the components need, in their joint order.
Selection selectNeeded(const EncodeInputs& inputs, const Candidates& candidates) {
  Selection selection = orderPackets(candidates);
  const Needs needs = {candidates.heights.need, candidates.texture.need};
  const auto quality_after = [&](Component component, uint64_t bytes) {
    return component == Component::kGeometry ? qualityAfter(inputs, candidates.heights, bytes)
                                             : qualityAfter(inputs, candidates.texture, bytes);
  };
  selection.packets = keepNeeded(selection.packets, needs, quality_after);
  return selection;
}

/// Payload bytes of the heights' packets up to the one that ends a late mask.
uint64_t bytesToMask(std::span<const Packet> packets, const GeometryLayers& layers) {
  uint64_t bytes = 0;
  for (const Packet& packet : packets) {
    if (packet.component != Component::kGeometry) continue;
    bytes += packet.length();
    if (packet.track == 0 && packet.end >= layers.maskEnd()) break;
  }
  return bytes;
}

/// The packets in an order in which a late mask of the heights ends within the budget, if the
/// budget has room for the mask. Cameras may value a texture more, but a texture without its ground
/// is of no use.
Selection withMaskInBudget(const EncodeInputs& inputs, Selection selection) {
  if (!selection.heights || !selection.texture || !selection.heights->layers.late_mask)
    return selection;
  const uint64_t header = headerBytesOf(inputs, selection);
  const uint64_t room = inputs.options.bytes - std::min(inputs.options.bytes, header);
  const uint64_t needed = bytesToMask(selection.packets, selection.heights->layers);
  if (needed <= room)
    selection.packets = endWithin(selection.packets, Component::kGeometry, needed, room);
  return selection;
}

/// Selects as many packets as the budget has room for.
Selection meetBudget(const EncodeInputs& inputs, Candidates lossy) {
  lossy = withCurves(inputs, std::move(lossy));
  Selection selection = withMaskInBudget(inputs, orderPackets(lossy));
  std::optional<Selection> exact = exactWithinBudget(inputs, lossy, selection);
  if (!exact) return selection;
  noteOthers(inputs, *exact, selection);
  return *std::move(exact);
}

/// The first bytes of the texture's packets that reach the PSNR; all of them where none do.
uint64_t textureNeed(const EncodeInputs& inputs, const TextureCandidate& texture) {
  const CodedTexture& coded = *texture.coded;
  const auto& packets = texture.curve->packets;
  const std::optional<uint64_t> least = leastBytes(packets, [&](uint64_t bytes) {
    return reachesPsnr(inputs, coded, prefixAfter(coded.accounted(), packets, bytes));
  });
  return least.value_or(payloadOf(packets));
}

/// The heights with the bytes that the PSNR needs, or heights to the last bit where these take
/// fewer.
HeightsCandidate preferExact(const EncodeInputs& inputs, HeightsCandidate lossy) {
  const double steps = rmseOf(qualityAfter(inputs, lossy, lossy.bytes()));
  const auto exact =
      exactHeightsFor(inputs, steps * lossy.coded->quantised->steps.step, lossy.bytes());
  if (!exact) return lossy;
  return fewestBytes<CodedHeights>({std::move(lossy), {exact}}, notingLonger(inputs));
}

/// Heights of the PSNR. They are coded to the last bit where no lossy heights reach it, as with
/// floats that are on no grid, unless the caller's step forbids it.
Result<HeightsCandidate> reachingPsnr(const EncodeInputs& inputs, HeightsCandidate lossy) {
  if (const std::optional<uint64_t> need = heightsNeed(inputs, lossy)) {
    lossy.need = *need;
    return preferExact(inputs, std::move(lossy));
  }
  const bool any_step = inputs.heights->step == 0;
  if (const auto exact = any_step ? exactHeightsFor(inputs, 0, UINT64_MAX) : nullptr) {
    note(inputs, *lossy.coded, Verdict::kMissesTarget);
    return HeightsCandidate{exact};
  }
  return Status(TKS_USAGE,
                "This PSNR is above what the step of the heights allows; give a smaller step.");
}

/// The candidate, or its lossless sibling if the need lies next to the last bit and the sibling
/// takes fewer bytes.
TextureCandidate preferExact(const EncodeInputs& inputs, TextureCandidate lossy) {
  if (!hasLosslessWay(*lossy.coded)) return lossy;
  const double rmse = rmseOf(qualityAfter(inputs, lossy, lossy.bytes()));
  if (rmse > kNearlyExact * gapOfValues(*lossy.coded)) return lossy;
  TextureCandidate lossless = codeLossless(inputs, *lossy.coded);
  return fewestBytes<CodedTexture>({std::move(lossy), std::move(lossless)}, notingLonger(inputs));
}

/// Each component reaches the PSNR by itself.
Result<Selection> meetPsnr(const EncodeInputs& inputs, Candidates candidates) {
  candidates = withCurves(inputs, std::move(candidates));
  auto& [heights, texture, errors] = candidates;
  if (heights.coded) {
    Result<HeightsCandidate> reaching = reachingPsnr(inputs, std::move(heights));
    if (!reaching.ok()) return reaching.status();
    heights = storedIfShorter(inputs, *std::move(reaching));
  }
  if (texture.coded) {
    texture.need = textureNeed(inputs, texture);
    texture = storedIfShorter(inputs, preferExact(inputs, std::move(texture)));
  }
  return selectNeeded(inputs, withCurves(inputs, std::move(candidates)));
}

/// Keeps the heights whole, because they were made for the target. The texture gets as many bytes
/// as suit the heights, or every bit where all of it takes no more bytes or all is to be lossless.
Selection meetWholeHeights(const EncodeInputs& inputs, Candidates candidates) {
  auto& [heights, texture, errors] = candidates;
  if (inputs.options.max_error > 0 && texture.coded) {
    if (!texture.curve) texture.curve = curveOfTexture(inputs, *texture.coded);
    texture.need = textureBesideBound(inputs, candidates);
    texture = preferExact(inputs, std::move(texture));
  }
  if (heights.coded) heights = storedIfShorter(inputs, std::move(heights));
  if (texture.coded) texture = storedIfShorter(inputs, std::move(texture));
  return selectNeeded(inputs, withCurves(inputs, std::move(candidates)));
}

Result<Selection> selectPackets(const EncodeInputs& inputs, Candidates candidates) {
  if (inputs.budgeted()) return meetBudget(inputs, std::move(candidates));
  if (inputs.options.psnr > 0) return meetPsnr(inputs, std::move(candidates));
  return meetWholeHeights(inputs, std::move(candidates));
}

}  // namespace

Result<Selection> meetTarget(const EncodeInputs& inputs,
                             std::shared_ptr<const CodedHeights> heights,
                             std::shared_ptr<const CodedTexture> texture) {
  assert((heights != nullptr) == (inputs.heights != nullptr));
  assert((texture != nullptr) == (inputs.image != nullptr));
  Result<Selection> selection = selectPackets(inputs, {{std::move(heights)}, {std::move(texture)}});
  if (!selection.ok()) return selection;
  std::vector<Packet>& packets = selection->packets;
  packets = joinNeighbours(packets);
  if (inputs.budgeted()) packets = keepWithinBudget(packets, inputs.options.bytes);
  return selection;
}

}  // namespace tetrakis::inline targets
