// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_encoder.hpp"

#include <algorithm>
#include <cmath>

#include "texture_wavelet/colour_fit.hpp"
#include "texture_wavelet/norms.hpp"
#include "texture_wavelet/texture_plan.hpp"

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

BandSource gather(const std::vector<int32_t>& plane, uint32_t width, const Subband& subband,
                  const BandShape& shape) {
  BandSource source;
  source.values.assign(shape.cells(), 0);
  for (uint32_t row = 0; row < subband.height; ++row) {
    const int32_t* from = plane.data() + size_t{subband.y + row} * width + subband.x;
    std::copy(from, from + subband.width,
              source.values.begin() + static_cast<ptrdiff_t>(shape.cell(row, 0)));
  }
  return source;
}

TextureHeader makeHeader(const Texels& texels, const ColourTransform& colour,
                         const std::vector<double>& energies) {
  TextureHeader header;
  header.width = texels.width;
  header.height = texels.height;
  header.channels = static_cast<uint8_t>(texels.channels);
  header.sample = texels.bits == 8 ? TKS_U8 : TKS_U16;
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

}  // namespace

EncodedTexture encodeTexture(const Texels& texels, uint64_t limit) {
  Planes planes = separate(texels);
  std::vector<int32_t*> pointers;
  for (std::vector<int32_t>& plane : planes) pointers.push_back(plane.data());
  const size_t count = size_t{texels.width} * texels.height;
  const ColourTransform colour =
      fitColour({pointers.data(), pointers.size()}, texels.width, texels.height);
  forwardColour(colour, pointers, count);
  const std::vector<double> energies = energiesOf(texels, colour);
  EncodedTexture encoded{makeHeader(texels, colour, energies), {}};
  const TexturePlan plan(encoded.header);
  std::vector<BandSource> sources;
  for (uint32_t c = 0; c < texels.channels; ++c) {
    forwardWavelet(planes[c], texels.width, texels.height);
    for (const Subband& subband : plan.subbands()) {
      BandSource source =
          gather(planes[c], texels.width, subband, plan.bands()[sources.size()].shape);
      source.weight = normOf(subband) * normOf(subband) * energies[c];
      sources.push_back(std::move(source));
    }
    planes[c] = {};
  }
  encoded.track = encodeTrack(plan.bands(), sources, plan, limit);
  encoded.header.planes = static_cast<uint8_t>(encoded.track.planes);
  return encoded;
}

}  // namespace tetrakis
