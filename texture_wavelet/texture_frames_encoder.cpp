// SPDX-License-Identifier: Apache-2.0
// The frames of a texture share one colour transform, which is fitted to the first one.
#include <algorithm>
#include <cassert>
#include <utility>

#include "codec/frames/frames_encoder.hpp"
#include "codec/wavelet/choice/filter_choice.hpp"
#include "texture_wavelet/colour/colour_fit.hpp"
#include "texture_wavelet/texture_decoder.hpp"
#include "texture_wavelet/texture_encoder.hpp"

namespace tetrakis::inline texture {

namespace {

std::vector<std::vector<int32_t>> channelsOf(const Texels& texels) {
  const size_t count = texels.extent().samples();
  std::vector<std::vector<int32_t>> channels(texels.channels, std::vector<int32_t>(count));
  for (size_t i = 0; i < count; ++i)
    for (size_t c = 0; c < channels.size(); ++c)
      channels[c][i] = texels.samples[i * texels.channels + c];
  return channels;
}

/// Frames have no shears of coefficients: those of samples go at all levels.
ColourTransform colourOfFrames(const Texels& first, Purpose purpose) {
  const std::vector<std::vector<int32_t>> channels = channelsOf(first);
  std::vector<const int32_t*> pointers;
  for (const std::vector<int32_t>& channel : channels) pointers.push_back(channel.data());
  ColourTransform colour = purpose == Purpose::kLossy
                               ? fitColour(pointers, first.extent())
                               : chooseLosslessColour(pointers, first.extent());
  colour.level_shears.clear();
  if (channels.size() % 2 == 0 && first.opaque)
    colour.further_shears = fitFurtherColour(colour, pointers, first.extent(), purpose);
  return colour;
}

TextureHeader headerOfFrames(const Texels& first, const ColourTransform& colour) {
  TextureHeader header;
  header.width = first.width;
  header.height = first.height;
  header.channels = static_cast<uint8_t>(first.channels);
  header.opaque = first.opaque;
  header.white_level = first.white_level;
  header.sample = first.bits == 8 ? TKS_U8 : TKS_U16;
  describeColour(colour, header);
  header.priority = prioritiesOf(first.channels, colour, {1, 1, 1, 1});
  return header;
}

FrameSource sourceOf(const std::vector<Texels>& frames, const ColourTransform& colour,
                     const TextureHeader& header) {
  FrameSource source;
  source.layout = frameLayoutOf(header);
  source.squares = energiesOf(header.channels, colour, 1, {1, 1, 1, 1});
  for (const Texels& frame : frames) {
    std::vector<std::vector<int32_t>> planes = channelsOf(frame);
    std::vector<int32_t*> pointers;
    for (std::vector<int32_t>& plane : planes) pointers.push_back(plane.data());
    forwardColour(colour, pointers, frame.extent().samples(), 0);
    std::move(planes.begin(), planes.end(), std::back_inserter(source.planes));
  }
  return source;
}

/// A way to code frames: with colours of their own, or going on from the group before.
struct TextureWay {
  TextureHeader header;
  FrameSource source;
  TimeCoding coding;

  TextureWay(const std::vector<Texels>& frames, const ColourTransform& colour,
             const std::optional<TextureBefore>& before = {})
      : header(headerOfFrames(frames.front(), colour)) {
    header.frames.count = static_cast<uint8_t>(frames.size());
    if (before) {
      header.frames.reference = before->bytes;
      header.frames.before.decode = [last = before->last] { return last; };
    }
    source = sourceOf(frames, colour, header);
    coding = chooseTimeCoding(source, frames.front().bits);
  }
};

}  // namespace

EncodedTexture encodeTextureFrames(const std::vector<Texels>& frames, bool ring, Purpose purpose,
                                   const TextureOptions& options,
                                   const std::optional<TextureBefore>& before) {
  assert(!frames.empty() && frames.size() <= FramesHeader::kMost);
  const Texels& first = frames.front();
  TextureWay way(frames, colourOfFrames(first, purpose));
  if (before) {
    TextureWay going_on(frames, colourOf(*before->header), before);
    if (going_on.coding.bits < way.coding.bits) way = std::move(going_on);
  }
  FrameSource& source = way.source;
  const TimeCoding& coding = way.coding;
  const WaveletHeader wavelet = chooseFrameWavelet(source, coding.filter, first.bits, purpose);
  EncodedTexture encoded{std::move(way.header), {}};
  TextureHeader& header = encoded.header;
  header.regions.side_log2 = static_cast<uint8_t>(options.region_log2);
  header.frames.filter = coding.filter;
  header.wavelet = options.windows ? withShortReach(wavelet) : wavelet;
  header.wavelet.ring = ring;
  source.layout = frameLayoutOf(header);
  const bool whole = header.wavelet.fraction_bits == 0;
  const uint64_t samples = frames.size() * first.samples.size();
  encoded.tracks = encodeFramePlanes(std::move(source), untilReached(options, samples));
  header.planes = static_cast<uint8_t>(encoded.tracks.front().planes);
  if (whole) header.wavelet.rounded_bytes = roundedBytes(encoded.tracks, 0);
  return encoded;
}

}  // namespace tetrakis::inline texture
