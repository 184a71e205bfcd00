// SPDX-License-Identifier: Apache-2.0
#include "encoder/meet_target.hpp"

#include <cassert>
#include <optional>
#include <utility>
#include <vector>

#include "codec/geometry/voids.hpp"
#include "encoder/candidates.hpp"
#include "encoder/height_errors.hpp"
#include "encoder/write_stream.hpp"
#include "ratecontrol/allocation.hpp"
#include "ratecontrol/target.hpp"

namespace tetrakis {

namespace {

/// The packets that the components need, in their joint order.
Selection selectNeeded(const EncodeInputs& inputs, const Candidates& candidates) {
  Selection selection = orderPackets(candidates);
  const auto& [heights, texture] = candidates;
  selection.packets = keepNeeded(
      selection.packets, {heights.need, texture.need}, [&](Component component, uint64_t bytes) {
        return component == Component::kGeometry ? qualityAfter(inputs, heights, bytes)
                                                 : qualityAfter(inputs, texture, bytes);
      });
  return selection;
}

/// The budget buys so much of every component that losslessness is in reach.
bool nearlyExact(const EncodeInputs& inputs, const Selection& selection) {
  const auto rmse = statedWithin(selection.packets, inputs.options.bytes);
  return (!selection.heights || rmse[0] <= kNearlyExact) &&
         (!selection.texture || rmse[1] <= kNearlyExact);
}

/// Everything without fraction bits, if that is lossless within the budget. Drawn and stored
/// textures are so as they stand.
std::optional<Selection> losslessIfItFits(const EncodeInputs& inputs, const Candidates& lossy) {
  const bool direct = lossy.texture.coded && lossy.texture.coded->header.direct();
  if (direct && !lossy.heights.coded) return {};
  if (lossy.heights.coded && !lossy.heights.coded->of->steps.exact) return {};
  Candidates exact = lossy;
  uint64_t bytes = 0;
  if (lossy.heights.coded) {
    exact.heights = *tryLossless(inputs, lossy.heights);
    bytes += exact.heights.bytes();
  }
  if (lossy.texture.coded) {
    if (!direct) exact.texture = *tryLossless(inputs, lossy.texture);
    bytes += exact.texture.bytes();
  }
  if (bytes >= inputs.options.bytes) return {};
  Selection selection = orderPackets(withCurves(inputs, std::move(exact)));
  Selection joined = selection;
  joined.packets = joinNeighbours(selection.packets);
  if (!isLossless(inputs, joined)) return {};
  return selection;
}

/// As much as there is room for.
Selection meetBudget(const EncodeInputs& inputs, Candidates lossy) {
  lossy = withCurves(inputs, std::move(lossy));
  Selection selection = orderPackets(lossy);
  if (!nearlyExact(inputs, selection)) return selection;
  std::optional<Selection> exact = losslessIfItFits(inputs, lossy);
  return exact ? *std::move(exact) : selection;
}

/// The first bytes of the heights' packets that reach the PSNR. Where voids are belongs to what is
/// asked for.
std::optional<uint64_t> needOf(const EncodeInputs& inputs, const HeightsCandidate& heights) {
  const CodedHeights& coded = *heights.coded;
  const SampleRange range = rangeOf(*inputs.heights, coded.of->steps.valid);
  const double worst = worstMeanSquare(range.high - range.low, inputs.options.psnr);
  const auto& packets = heights.curve->packets;
  return leastBytes(packets, [&](uint64_t bytes) {
    if (bytes < coded.layers.validity_bytes) return false;
    const Codewords prefix = prefixAfter(coded.rated(), packets, bytes);
    return sampleErrorsOf(coded, prefix, inputs.options.threads).mean_square <= worst;
  });
}

/// All that the packets hold where no less reaches it.
uint64_t needOf(const EncodeInputs& inputs, const TextureCandidate& texture) {
  const CodedTexture& coded = *texture.coded;
  const auto& packets = texture.curve->packets;
  const std::optional<uint64_t> least = leastBytes(packets, [&](uint64_t bytes) {
    return reachesPsnr(inputs, coded, prefixAfter(coded.rated(), packets, bytes));
  });
  return least.value_or(payloadOf(packets));
}

/// The candidate, or its lossless sibling if the need lies next to the last bit and that takes
/// fewer bytes.
template <class Coded>
Candidate<Coded> preferLossless(const EncodeInputs& inputs, Candidate<Coded> lossy) {
  if (rmseOf(qualityAfter(inputs, lossy, lossy.bytes())) > kNearlyExact) return lossy;
  std::optional<Candidate<Coded>> lossless = tryLossless(inputs, lossy);
  if (!lossless) return lossy;
  return fewestBytes<Coded>({std::move(lossy), *std::move(lossless)});
}

/// Each component by itself.
Result<Selection> meetPsnr(const EncodeInputs& inputs, Candidates candidates) {
  auto& [heights, texture] = candidates = withCurves(inputs, std::move(candidates));
  if (heights.coded) {
    const std::optional<uint64_t> need = needOf(inputs, heights);
    if (!need) {
      return Status(TKS_USAGE,
                    "This PSNR is above what the step of the heights allows; give a smaller step.");
    }
    heights.need = *need;
    heights = storedIfShorter(inputs, preferLossless(inputs, std::move(heights)));
  }
  if (texture.coded) {
    texture.need = needOf(inputs, texture);
    texture = storedIfShorter(preferLossless(inputs, std::move(texture)));
  }
  return selectNeeded(inputs, withCurves(inputs, std::move(candidates)));
}

/// Heights whole, because they were made for the target. Unless all is to be lossless, the texture
/// gets what the order puts before the last of the heights' coefficients.
Selection meetWholeHeights(const EncodeInputs& inputs, Candidates candidates) {
  auto& [heights, texture] = candidates;
  if (inputs.options.max_error > 0 && texture.coded) {
    candidates = withCurves(inputs, std::move(candidates));
    const uint64_t coefficients = bytesOf(heights.coded->tracks) - heights.coded->closing;
    const Selection all = orderPackets(candidates);
    texture.need = sentWith(all.packets, Component::kGeometry, coefficients)[1];
  }
  if (heights.coded) heights = storedIfShorter(inputs, std::move(heights));
  if (texture.coded) texture = storedIfShorter(std::move(texture));
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

}  // namespace tetrakis
