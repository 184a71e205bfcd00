// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_encoder.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "texture_wavelet/colour_fit.hpp"
#include "texture_wavelet/drawn_encoder.hpp"
#include "texture_wavelet/lossless_colour.hpp"
#include "texture_wavelet/texture_plan.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis {

namespace {

using Planes = std::vector<std::vector<int32_t>>;

Planes separate(const Texels& texels) {
  const size_t count = size_t{texels.width} * texels.height;
  Planes planes(texels.channels, std::vector<int32_t>(count));
  for (size_t i = 0; i < count; ++i) {
    for (uint32_t c = 0; c < texels.channels; ++c)
      planes[c][i] = texels.samples[i * texels.channels + c];
  }
  return planes;
}

TextureHeader makeHeader(const Texels& texels, const ColourTransform& colour,
                         const WaveletHeader& wavelet, const std::vector<double>& energies) {
  TextureHeader header;
  header.width = texels.width;
  header.height = texels.height;
  header.channels = static_cast<uint8_t>(texels.channels);
  header.sample = texels.bits == 8 ? TKS_U8 : TKS_U16;
  header.wavelet = wavelet;
  header.centre = colour.centre;
  header.colour_order = colour.order;
  for (size_t i = 0; i < colour.shears.size(); ++i) header.colour_shears[i] = colour.shears[i];
  for (size_t c = 0; c < energies.size(); ++c) {
    const double priority = std::round(8 * std::log2(energies[c]));
    header.priority[c] = static_cast<int64_t>(std::clamp(priority, -128.0, 128.0));
  }
  return header;
}

/// Squared error of all channels per squared error of each component; alpha counts like a colour.
std::vector<double> energiesOf(const Texels& texels, const ColourTransform& colour) {
  std::vector<double> energies(texels.channels, 1.0);
  if (texels.channels >= 3) {
    const std::array<double, 3> rgb = componentEnergies(colour);
    std::copy(rgb.begin(), rgb.end(), energies.begin());
  }
  return energies;
}

/// Samples that go through the colour transform together: few enough for the cache.
constexpr size_t kChunk = 2048;

void transformColours(const ColourTransform& colour, int fraction_bits, Planes& planes) {
  const size_t count = planes.front().size();
  std::vector<int32_t*> chunk(planes.size());
  for (size_t first = 0; first < count; first += kChunk) {
    for (size_t c = 0; c < planes.size(); ++c) chunk[c] = planes[c].data() + first;
    forwardColour(colour, chunk, std::min(kChunk, count - first), fraction_bits);
  }
}

ColourTransform fitColours(const Planes& planes, const Texels& texels, Purpose purpose) {
  std::vector<const int32_t*> pointers;
  for (const std::vector<int32_t>& plane : planes) pointers.push_back(plane.data());
  const ColourTransform fitted = fitColour(pointers, texels.width, texels.height);
  if (purpose == Purpose::kLossy) return fitted;
  return chooseLosslessColour(fitted, pointers, texels.width, texels.height);
}

/// Applies the colour transform and chooses the wavelet: for the last bit by all that comes out of
/// it, else by green, or grey, because it must be known how many fraction bits go in.
WaveletHeader transformColours(const ColourTransform& colour, Purpose purpose, const Texels& texels,
                               Planes& planes) {
  const auto choose = [&](std::span<const std::span<const int32_t>> typical) {
    return chooseWavelet(typical, {}, texels.width, texels.height, texels.bits, purpose);
  };
  if (purpose == Purpose::kLossless) {
    transformColours(colour, 0, planes);
    return choose(std::vector<std::span<const int32_t>>(planes.begin(), planes.end()));
  }
  const std::span<const int32_t> typical = planes[texels.channels >= 3 ? 1 : 0];
  const WaveletHeader wavelet = choose(std::span(&typical, 1));
  transformColours(colour, wavelet.fraction_bits, planes);
  return wavelet;
}

EncodedTexture encodeByWavelet(const Texels& texels, Purpose purpose, uint64_t limit) {
  Planes planes = separate(texels);
  const ColourTransform colour = fitColours(planes, texels, purpose);
  const WaveletHeader wavelet = transformColours(colour, purpose, texels, planes);
  const std::vector<double> energies = energiesOf(texels, colour);
  EncodedTexture encoded{makeHeader(texels, colour, wavelet, energies), {}};
  const TexturePlan plan(encoded.header);
  const PlaneLayout& layout = plan.layout();
  const double unit = std::exp2(-2 * wavelet.fraction_bits);
  std::vector<BandSource> sources;
  for (uint32_t c = 0; c < texels.channels; ++c) {
    forwardWavelet(specOf(wavelet), planes[c], texels.width, texels.height);
    for (size_t i = 0; i < layout.size(); ++i) {
      sources.push_back({gather(planes[c], texels.width, layout.subbands()[i]),
                         layout.energy(i) * energies[c] * unit});
    }
    planes[c] = {};
  }
  encoded.track = encodeTrack(plan.bands(), sources, limit);
  encoded.header.planes = static_cast<uint8_t>(encoded.track.planes);
  return encoded;
}

double distortionAt(const EncodedTrack& track, uint64_t bytes) {
  const std::vector<RatePoint>& points = track.points;
  const auto above = std::find_if(points.begin(), points.end(),
                                  [&](const RatePoint& p) { return p.bytes > bytes; });
  if (above == points.begin() || above == points.end()) return points.back().distortion;
  const RatePoint &low = *(above - 1), &high = *above;
  const double part =
      static_cast<double>(bytes - low.bytes) / static_cast<double>(high.bytes - low.bytes);
  return std::lerp(low.distortion, high.distortion, part);
}

}  // namespace

/// A drawn texture is better than the wavelet where its last byte is in reach, and worse before, if
/// it has many colours. It also must take no more bytes than the wavelet needs for the last bit; or
/// half of them, if the last bit is not asked for.
EncodedTexture encodeTexture(const Texels& texels, Purpose purpose, uint64_t limit) {
  std::optional<EncodedTexture> drawn = encodeDrawn(texels);
  if (!drawn) return encodeByWavelet(texels, purpose, limit);
  const uint64_t bytes = drawn->track.codeword.size(), reach = limit / 2;
  if (bytes > reach) {
    EncodedTexture wavelet = encodeByWavelet(texels, purpose, limit);
    return distortionAt(drawn->track, reach) < distortionAt(wavelet.track, reach) ? *drawn
                                                                                  : wavelet;
  }
  const uint64_t room = purpose == Purpose::kLossless ? bytes : 2 * bytes;
  const bool better = !encodeByWavelet(texels, Purpose::kLossless, room).track.complete;
  return better ? *drawn : encodeByWavelet(texels, purpose, limit);
}

}  // namespace tetrakis
