// SPDX-License-Identifier: Apache-2.0
#include "encoder/groups/coded_frames.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/portable_math.hpp"
#include "codec/geometry/heights_decoder.hpp"
#include "codec/geometry/quantiser/height_steps.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "texture_wavelet/texture_decoder.hpp"
#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis::inline groups {

namespace {

/// log2 of the squared error of a sample of unknown validity over the squared range.
constexpr double kValidityLog2 = -4;

double validityWorth(const FrameSteps& steps) {
  return portable::exp2(2.0 * steps.range_bits + kValidityLog2);
}

GeometryLayers layersOf(const tks_heights& first, uint64_t validity_bytes) {
  const bool has_nodata = statesNodata(first);
  return {.validity_bytes = validity_bytes,
          .has_nodata = has_nodata,
          .nodata = has_nodata ? first.nodata + 0.0 : 0};
}

GeometryHeader headerOf(const tks_heights& first, const FrameSteps& steps) {
  GeometryHeader header;
  header.width = first.width;
  header.height = first.height;
  header.sample = static_cast<uint8_t>(first.sample);
  header.exact = steps.exact;
  header.base = steps.base;
  header.step = steps.step;
  header.frames.count = static_cast<uint8_t>(steps.steps.size());
  header.frames.scales = steps.scales;
  header.wavelet.ring = first.domain == TKS_DOMAIN_CYLINDER;
  return header;
}

/// The first track with the masks ahead of its coefficients.
void prepend(std::span<const uint8_t> masks, double worth, EncodedTrack& track) {
  if (masks.empty()) return;
  track.codeword.insert(track.codeword.begin(), masks.begin(), masks.end());
  for (RatePoint& point : track.points) point.bytes += masks.size();
  track.points.insert(track.points.begin(), {0, track.points.front().distortion + worth});
}

uint64_t samplesOf(const Planes& planes) {
  return planes.size() * planes.front().size();
}

}  // namespace

double HeightFrames::counted() const {
  return static_cast<double>(std::max<uint64_t>(truth.validSamples(), 1));
}

double HeightFrames::squaresOf(const Codewords& prefix, uint32_t threads,
                               HeightsMemory* memory) const {
  HeightsMemory of_this_call;
  HeightsMemory& kept = memory != nullptr ? *memory : of_this_call;
  double squares = 0;
  for (uint32_t t = 0; t < truth.steps.size(); ++t) {
    const View view{0, {}, t};
    const DecodedGeometry shown =
        decodeHeights(coded->header, coded->layers, prefix, view, {threads, &kept}).geometry;
    const std::vector<uint8_t> valid = shownMarks(truth.masks[t], {});
    const double own = portable::exp2(truth.scale(t).shift);
    const double unit = portable::exp2(-shown.fraction_bits);
    for (size_t i = 0; i < shown.heights.size(); ++i) {
      const bool is_valid = valid.empty() || valid[i] != 0;
      const bool is_shown = shown.valid.empty() || shown.valid[i] != 0;
      if (is_valid != is_shown) {
        squares += validityWorth(truth);
      } else if (is_valid) {
        const double error = own * (shown.heights[i] * unit - truth.steps[t][i]);
        squares += error * error;
      }
    }
  }
  return squares;
}

namespace {

/// A way to code the heights of a group: in steps of its own, or going on from the group before.
struct HeightWay {
  FrameSteps truth;
  GeometryHeader header;
  FrameSource source;
  std::vector<uint8_t> masks;
  TimeCoding coding;

  /// The bits that coefficients take down to steps of another size, estimated.
  double bitsAt(double step) const {
    return coding.bits + static_cast<double>(truth.validSamples()) * std::log2(truth.step / step);
  }
};

/// A largest error is kept by the steps alone, so that all of them have to come back.
bool needsAllSteps(const tks_encode_options& options) {
  return options.lossless != 0 || options.max_error > 0;
}

/// reference: what the frames go on from; null: nothing.
HeightWay wayOf(const GroupInputs& inputs, FrameSteps truth,
                const std::shared_ptr<const FrameReference>& reference) {
  HeightWay way;
  way.truth = std::move(truth);
  way.header = headerOf(inputs.heights.front(), way.truth);
  if (reference != nullptr) {
    way.header.frames.reference = inputs.before->bytes;
    way.header.frames.before.decode = [reference] { return reference; };
  }
  way.source.planes = filled(way.truth).steps;
  way.source.layout = frameLayoutOf(way.header);
  way.masks = encodeFrameMasks(way.truth.masks, way.source.layout.extent);
  if (!way.masks.empty()) way.source.lifted = everValid(way.truth.masks);
  const auto valid = static_cast<double>(std::max<uint64_t>(way.truth.validSamples(), 1));
  way.source.share = valid / static_cast<double>(samplesOf(way.source.planes));
  way.coding = chooseTimeCoding(way.source, way.truth.range_bits + 1);
  return way;
}

/// Of lossy streams: how much coarser than the steps of a group those of the group before may be.
constexpr double kCoarser = 2;

/// The way that takes fewer bits.
Result<HeightWay> chooseWay(const GroupInputs& inputs) {
  Result<FrameSteps> found = stepsOfFrames(inputs.heights, inputs.options);
  std::optional<FrameSteps> like;
  if (inputs.before != nullptr && inputs.before->last_heights != nullptr)
    like = stepsLike(*inputs.before->heights, inputs.heights, inputs.options);
  if (!found.ok() && !like) return found.status();
  if (!like) return wayOf(inputs, *std::move(found), nullptr);
  HeightWay going_on = wayOf(inputs, *std::move(like), inputs.before->last_heights);
  if (!found.ok()) return going_on;
  const bool all = needsAllSteps(inputs.options);
  if (!all && going_on.truth.step > kCoarser * found->step)
    return wayOf(inputs, *std::move(found), nullptr);
  HeightWay alone = wayOf(inputs, *std::move(found), nullptr);
  // Both keep a promise, whatever their steps; lossy ones are compared at the same error.
  const double bits = all ? going_on.coding.bits : going_on.bitsAt(alone.truth.step);
  return bits < alone.coding.bits ? std::move(going_on) : std::move(alone);
}

}  // namespace

Result<HeightFrames> codeHeightFrames(const GroupInputs& inputs) {
  const tks_encode_options& options = inputs.options;
  Result<HeightWay> way = chooseWay(inputs);
  if (!way.ok()) return way.status();
  HeightFrames frames{std::move(way->truth), nullptr};
  const tks_heights& first = inputs.heights.front();
  const TimeCoding& coding = way->coding;
  const std::vector<uint8_t>& masks = way->masks;
  FrameSource& source = way->source;
  const Purpose purpose = needsAllSteps(options) ? Purpose::kLossless : Purpose::kLossy;
  const WaveletHeader wavelet =
      chooseFrameWavelet(source, coding.filter, frames.truth.range_bits + 1, purpose);
  CodedHeights coded;
  coded.header = std::move(way->header);
  const CoefficientOptions given = heightOptions(inputs.first());
  coded.header.frames.filter = coding.filter;
  coded.header.wavelet = given.windows ? withShortReach(wavelet) : wavelet;
  coded.header.wavelet.ring = first.domain == TKS_DOMAIN_CYLINDER;
  coded.header.regions.side_log2 = static_cast<uint8_t>(given.region_log2);
  source.layout = frameLayoutOf(coded.header);
  coded.layers = layersOf(first, masks.size());
  coded.tracks = encodeFramePlanes(std::move(source), {given.limit, options.threads});
  coded.header.planes = static_cast<uint8_t>(coded.tracks.front().planes);
  if (wavelet.fraction_bits == 0)
    coded.header.wavelet.rounded_bytes = roundedBytes(coded.tracks, 0);
  prepend(masks, validityWorth(frames.truth) * frames.counted(), coded.tracks.front());
  frames.coded = std::make_shared<const CodedHeights>(std::move(coded));
  return frames;
}

double TextureFrames::counted() const {
  return static_cast<double>(truth.size() * truth.front().samples.size());
}

double TextureFrames::squaresOf(const Codewords& prefix, uint32_t threads,
                                TextureMemory* memory) const {
  TextureMemory of_this_call;
  TextureMemory& kept = memory != nullptr ? *memory : of_this_call;
  double squares = 0;
  for (uint32_t t = 0; t < truth.size(); ++t) {
    const Texels shown = decodeTexture(coded->header, prefix, {0, {}, t}, {threads, &kept});
    for (size_t i = 0; i < shown.samples.size(); ++i) {
      const double error = double{0} + shown.samples[i] - truth[t].samples[i];
      squares += error * error;
    }
  }
  return squares;
}

TextureFrames codeTextureFrames(const GroupInputs& inputs, bool to_the_end) {
  TextureFrames frames;
  std::shared_ptr<const TextureSource> first;
  for (const tks_image& image : inputs.images) {
    std::shared_ptr<const TextureSource> source = quantiseTexture(image);
    frames.truth.push_back(source->texels);
    if (first == nullptr) first = std::move(source);
  }
  const EncodeInputs like_first = inputs.first();
  TextureOptions options = textureOptions(like_first, first->texels);
  if (to_the_end) options.mean_square = 0;
  std::optional<TextureBefore> before;
  if (inputs.before != nullptr && inputs.before->last_texture != nullptr)
    before = {inputs.before->bytes, &*inputs.before->texture, inputs.before->last_texture};
  EncodedTexture encoded =
      encodeTextureFrames(frames.truth, first->ring, purposeOf(like_first), options, before);
  frames.coded = std::make_shared<const CodedTexture>(
      CodedTexture{std::move(first), std::move(encoded.header), std::move(encoded.tracks)});
  return frames;
}

}  // namespace tetrakis::inline groups
