// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_decoder.hpp"

#include <algorithm>
#include <memory>

#include "bitstream/track_decoder.hpp"
#include "texture_wavelet/texture_plan.hpp"
#include "wavelet/mip_level.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis {

namespace {

/// Samples that go through the colour transform together: few enough for the cache.
constexpr size_t kChunk = 2048;

/// Components to interleaved samples.
void finish(const TextureHeader& header, int fraction_bits, std::span<int32_t* const> planes,
            Texels& texels) {
  const size_t count = size_t{texels.width} * texels.height;
  const int32_t most = (1 << texels.bits) - 1;
  const ColourTransform colour = colourOf(header);
  std::vector<int32_t*> chunk(planes.size());
  for (size_t first = 0; first < count; first += kChunk) {
    const size_t size = std::min(kChunk, count - first);
    for (size_t c = 0; c < planes.size(); ++c) chunk[c] = planes[c] + first;
    inverseColour(colour, chunk, size, fraction_bits);
    uint16_t* out = texels.samples.data() + first * planes.size();
    for (size_t c = 0; c < planes.size(); ++c) {
      for (size_t i = 0; i < size; ++i)
        out[i * planes.size() + c] = static_cast<uint16_t>(std::clamp(chunk[c][i], 0, most));
    }
  }
}

}  // namespace

Texels decodeTexture(const TextureHeader& header, std::span<const uint8_t> codeword, int level) {
  const TexturePlan plan(header);
  const MipLevel mip(header.width, header.height, level);
  std::vector<BandPlan> bands = plan.bands();
  const size_t per_component = plan.layout().size();
  for (uint32_t c = 0; c < header.channels; ++c) {
    mip.dropFiner(std::span(bands).subspan(c * per_component, per_component));
  }
  TrackState state = decodeTrack(bands, header.planes, codeword);
  const int fraction_bits = outputFractionBits(header.wavelet, header.planes, state.complete);
  const WaveletSpec spec = specOf(header.wavelet);
  const auto [width, height] = mip.low();
  const std::vector<Subband> subbands = subbandsOf(width, height);
  std::vector<std::unique_ptr<int32_t[]>> planes(header.channels);
  std::vector<int32_t*> pointers;
  for (uint32_t c = 0; c < header.channels; ++c) {
    const size_t count = size_t{width} * height;
    planes[c].reset(new int32_t[count]);  // every value is written: the bands fill the plane
    const std::span plane(planes[c].get(), count);
    for (size_t i = 0; i < subbands.size(); ++i) {
      scatter(state.bands[c * per_component + i], fraction_bits - header.wavelet.fraction_bits,
              subbands[i], plane, width);
    }
    inverseWavelet(mip.transform(spec), plane, width, height);
    mip.normalise(spec, plane);
    mip.thin(plane);
    pointers.push_back(plane.data());
  }
  state.bands.clear();
  const auto [columns, rows] = mip.size();
  Texels texels{columns, rows, header.channels, header.sample == TKS_U8 ? 8 : 16, {}};
  texels.samples.resize(size_t{columns} * rows * header.channels);
  finish(header, fraction_bits, pointers, texels);
  return texels;
}

}  // namespace tetrakis
