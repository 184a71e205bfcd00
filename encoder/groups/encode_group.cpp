// SPDX-License-Identifier: Apache-2.0
#include "encoder/groups/encode_group.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "base/portable_math.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "encoder/selection/write_stream.hpp"
#include "ratecontrol/allocation/allocation.hpp"
#include "ratecontrol/needs/needs.hpp"

namespace tetrakis::inline groups {

namespace {

/// Groups of more samples are decoded anew for each prefix that is measured, to save their memory.
constexpr uint64_t kRemembered = uint64_t{1} << 22;

TrackOrder trackOrderOf(const tks_encode_options& options) {
  if (options.index == TKS_INDEX_WINDOWS) return TrackOrder::kTracks;
  return options.index != TKS_INDEX_NONE ? TrackOrder::kClasses : TrackOrder::kSlopes;
}

/// A component of the group: its packets, and the errors of its prefixes.
struct Part {
  CodedTracks tracks;
  ComponentCurve curve;
  std::function<double(const Codewords&)> squares_of;
  double counted = 1;

  /// The mean squared error of the first bytes of the packets.
  double meanSquare(uint64_t bytes) const {
    return squares_of(prefixAfter(tracks, curve.packets, bytes)) / counted;
  }
};

using Parts = std::array<std::optional<Part>, kComponents>;

/// frames: HeightFrames or TextureFrames, which outlive the result.
template <class Memory>
Part partOf(const GroupInputs& inputs, const auto& frames) {
  const tks_encode_options& options = inputs.options;
  Part part{frames.coded->accounted(), {}, {}, frames.counted()};
  const auto samples = static_cast<uint64_t>(part.counted);
  const AuditScope scope{samples, options.bytes != 0 ? options.bytes : UINT64_MAX,
                         options.max_error > 0};
  Memory memory;
  memory.tracks.forgets = samples > kRemembered;
  const auto measure = [&](const std::vector<Packet>& packets, uint64_t bytes) {
    return frames.squaresOf(prefixAfter(part.tracks, packets, bytes), options.threads, &memory);
  };
  part.curve = curveOf(part.tracks, scope, measure,
                       {.samples = part.counted,
                        .shared = !inputs.heights.empty() && !inputs.images.empty(),
                        .order = trackOrderOf(options)});
  part.squares_of = [&frames, threads = options.threads](const Codewords& prefix) {
    return frames.squaresOf(prefix, threads, nullptr);
  };
  return part;
}

/// Squared errors of each component relative to those of its opening alone, which add.
PairErrors relativeErrors(const Part& heights, const Part& texture) {
  const auto first = [](const ComponentCurve& curve) {
    const double square = curve.points[curve.opened].distortion;
    return std::vector<double>{square > 0 ? square : 1};
  };
  return {{first(heights.curve), first(texture.curve)}, {2, 1, 1, 0}};
}

std::vector<Packet> ordered(const std::optional<Part>& heights,
                            const std::optional<Part>& texture) {
  std::optional<PairErrors> errors;
  if (heights && texture) errors = relativeErrors(*heights, *texture);
  std::vector<Packet> packets = errors ? allocate({heights->curve, texture->curve}, *errors)
                                       : (heights ? heights : texture)->curve.packets;
  stateSlopes(packets, {heights ? &heights->curve : nullptr, texture ? &texture->curve : nullptr},
              errors ? &*errors : nullptr);
  return packets;
}

/// The range of the valid samples of all frames, in steps.
double peakOf(const std::vector<tks_heights>& frames, const FrameSteps& steps) {
  double low = INFINITY, high = -INFINITY;
  for (size_t t = 0; t < frames.size(); ++t) {
    const std::vector<uint8_t> valid = shownMarks(steps.masks[t], {});
    if (!valid.empty() && std::find(valid.begin(), valid.end(), 1) == valid.end()) continue;
    const SampleRange range = rangeOf(frames[t], valid);
    low = std::min(low, range.low);
    high = std::max(high, range.high);
  }
  return high > low ? (high - low) / steps.step : 0;
}

/// The first bytes of a part that come as near as that; all of them where none do.
uint64_t need(const std::optional<Part>& part, double mean_square) {
  if (!part) return 0;
  const auto meets = [&](uint64_t bytes) { return part->meanSquare(bytes) <= mean_square; };
  return leastBytes(part->curve.packets, meets).value_or(payloadOf(part->curve.packets));
}

struct Group {
  std::optional<HeightFrames> heights;
  std::optional<TextureFrames> texture;
};

/// The bytes of each component that a PSNR of the heights and of the texture needs.
Needs needsOfPsnr(const GroupInputs& inputs, const Group& group, const Parts& parts) {
  const double psnr = inputs.options.psnr;
  Needs needs = {0, 0};
  if (group.heights)
    needs[0] = need(parts[0], worstMeanSquare(peakOf(inputs.heights, group.heights->truth), psnr));
  if (group.texture)
    needs[1] = need(parts[1], worstMeanSquare(group.texture->truth.front().white(), psnr));
  return needs;
}

/// All heights, since their steps keep the largest error. The texture gets the bytes that are worth
/// as much as those that bring heights as near to their steps as these are to the samples: to a
/// mean square of a 12th, that of errors spread evenly within a step. If heights take no bytes, it
/// gets all.
Needs needsBesideBound(const Parts& parts, std::span<const Packet> packets) {
  const uint64_t heights = need(parts[0], 1. / 12);
  if (heights == 0) return {kAllBytes, kAllBytes};
  return {kAllBytes, sentWith(packets, Component::kGeometry, heights)[1]};
}

/// The packets that the target needs, of those in their order.
std::vector<Packet> keepForTarget(const GroupInputs& inputs, const Group& group, const Parts& parts,
                                  std::vector<Packet> packets) {
  const bool is_bounded = inputs.options.max_error > 0 && group.heights && group.texture;
  if (inputs.options.psnr <= 0 && !is_bounded) return packets;
  const Needs needs =
      is_bounded ? needsBesideBound(parts, packets) : needsOfPsnr(inputs, group, parts);
  const auto quality_after = [&](Component component, uint64_t bytes) {
    return qualityOf(std::sqrt(parts[static_cast<size_t>(component)]->meanSquare(bytes)));
  };
  return keepNeeded(packets, needs, quality_after);
}

/// The texture, coded as far as its target needs.
TextureFrames textureFor(const GroupInputs& inputs) {
  TextureFrames frames = codeTextureFrames(inputs);
  if (inputs.options.psnr <= 0) return frames;
  const double most = worstMeanSquare(frames.truth.front().white(), inputs.options.psnr);
  const double squares =
      frames.squaresOf(codewordsOf(frames.coded->tracks), inputs.options.threads, nullptr);
  return squares / frames.counted() <= most ? frames : codeTextureFrames(inputs, true);
}

Result<std::vector<uint8_t>> encodeForTarget(const GroupInputs& inputs) {
  Group group;
  if (!inputs.heights.empty()) {
    Result<HeightFrames> heights = codeHeightFrames(inputs);
    if (!heights.ok()) return heights.status();
    group.heights = *std::move(heights);
  }
  if (!inputs.images.empty()) group.texture = textureFor(inputs);
  Parts parts;
  Selection selection;
  if (group.heights) {
    parts[0] = partOf<HeightsMemory>(inputs, *group.heights);
    selection.heights = group.heights->coded;
  }
  if (group.texture) {
    parts[1] = partOf<TextureMemory>(inputs, *group.texture);
    selection.texture = group.texture->coded;
  }
  selection.packets = keepForTarget(inputs, group, parts, ordered(parts[0], parts[1]));
  selection.packets = joinNeighbours(selection.packets);
  if (inputs.options.bytes != 0)
    selection.packets = keepWithinBudget(selection.packets, inputs.options.bytes);
  return writeStream(inputs.first(), selection);
}

/// Frames to the last bit, if the budget holds them.
std::optional<std::vector<uint8_t>> losslessWithin(const GroupInputs& inputs) {
  tks_encode_options options = inputs.options;
  options.bytes = 0;
  options.lossless = 1;
  Result<std::vector<uint8_t>> stream = encodeForTarget({inputs.heights, inputs.images, options});
  if (!stream.ok() || stream->size() > inputs.options.bytes) return std::nullopt;
  return *std::move(stream);
}

}  // namespace

Result<std::vector<uint8_t>> encodeGroup(const GroupInputs& inputs) {
  Result<std::vector<uint8_t>> stream = encodeForTarget(inputs);
  // Where a budget is not used up, its lossy coefficients end at roundings.
  const bool is_left = stream.ok() && inputs.options.bytes > stream->size();
  if (!is_left) return stream;
  std::optional<std::vector<uint8_t>> exact = losslessWithin(inputs);
  if (exact) return *std::move(exact);
  return stream;
}

}  // namespace tetrakis::inline groups
