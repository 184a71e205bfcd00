// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_decoder.hpp"

#include <algorithm>
#include <memory>

#include "bitstream/track_decoder.hpp"
#include "texture_wavelet/drawn_decoder.hpp"
#include "texture_wavelet/texture_plan.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis {

namespace {

/// Samples that go through the colour transform together: few enough for the cache.
constexpr size_t kChunk = 2048;

/// Components to interleaved samples.
void finish(const TextureHeader& header, int fraction_bits, std::span<int32_t* const> planes,
            Texels& texels) {
  const size_t count = size_t{header.width} * header.height;
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

Texels decodeTexture(const TextureHeader& header, std::span<const uint8_t> codeword) {
  if (header.drawn()) return decodeDrawn(header, codeword);
  Texels texels{header.width, header.height, header.channels, header.sample == TKS_U8 ? 8 : 16, {}};
  const size_t count = size_t{header.width} * header.height;
  const TexturePlan plan(header);
  const PlaneLayout& layout = plan.layout();
  TrackState state = decodeTrack(plan.bands(), header.planes, codeword);
  const int fraction_bits = outputFractionBits(header.wavelet, header.planes, state.complete);
  std::vector<std::unique_ptr<int32_t[]>> planes(header.channels);
  std::vector<int32_t*> pointers;
  for (uint32_t c = 0; c < header.channels; ++c) {
    planes[c].reset(new int32_t[count]);  // every value is written: the bands fill the plane
    const std::span plane(planes[c].get(), count);
    for (size_t i = 0; i < layout.size(); ++i) {
      scatter(state.bands[c * layout.size() + i], fraction_bits - header.wavelet.fraction_bits,
              layout.subbands()[i], plane, header.width);
    }
    inverseWavelet(specOf(header.wavelet), plane, header.width, header.height);
    pointers.push_back(plane.data());
  }
  state.bands.clear();
  texels.samples.resize(count * header.channels);
  finish(header, fraction_bits, pointers, texels);
  return texels;
}

}  // namespace tetrakis
