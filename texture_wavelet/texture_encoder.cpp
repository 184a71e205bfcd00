// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_encoder.hpp"

#include <algorithm>
#include <cmath>

#include "bitstream/parallel.hpp"
#include "texture_wavelet/colour_fit.hpp"
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

/// What the header says of tracks that are complete.
uint64_t wholeBytes(const EncodedTexture& encoded) {
  uint64_t bytes = 0;
  if (encoded.header.regions.side_log2 == 0) return 0;
  for (const EncodedTrack& track : encoded.tracks) {
    if (!track.complete) return 0;
    bytes += track.codeword.size();
  }
  return bytes;
}

}  // namespace

EncodedTexture encodeTexture(const Texels& texels, Purpose purpose, const TrackOptions& options) {
  Planes planes = separate(texels);
  const std::vector<int32_t>& typical = planes[texels.channels >= 3 ? 1 : 0];  // green, or grey
  const WaveletHeader wavelet =
      chooseWavelet(typical, {}, texels.width, texels.height, texels.bits, purpose);
  const ColourTransform colour = fitColours(planes, texels, purpose);
  transformColours(colour, wavelet.fraction_bits, planes);
  const std::vector<double> energies = energiesOf(texels, colour);
  EncodedTexture encoded{makeHeader(texels, colour, wavelet, energies), {}};
  encoded.header.regions.side_log2 = static_cast<uint8_t>(options.region_log2);
  const TexturePlan plan(encoded.header);
  const double unit = std::exp2(-2 * wavelet.fraction_bits);
  std::vector<TrackSource> sources(plan.regions().size());
  for (size_t i = 0; i < sources.size(); ++i) sources[i].plan = plan.bands(plan.parts(i));
  for (uint32_t c = 0; c < texels.channels; ++c) {
    forwardWavelet(specOf(wavelet), planes[c], texels.width, texels.height, {}, options.threads);
    parallelFor(options.threads, sources.size(), [&](size_t i) {
      for (const BandPart& part : plan.parts(i)) {
        const Subband& subband = plan.layout().subbands()[part.subband];
        sources[i].bands.push_back({gather(planes[c], texels.width, subband, part),
                                    plan.layout().energy(part.subband) * energies[c] * unit});
      }
    });
    planes[c] = {};
  }
  encoded.tracks = encodeTracks(sources, options);
  encoded.header.planes = static_cast<uint8_t>(encoded.tracks.front().planes);
  encoded.header.regions.whole_bytes = wholeBytes(encoded);
  return encoded;
}

}  // namespace tetrakis
