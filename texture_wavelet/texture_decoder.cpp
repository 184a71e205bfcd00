// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_decoder.hpp"

#include <algorithm>
#include <memory>

#include "bitstream/parallel.hpp"
#include "texture_wavelet/texture_plan.hpp"
#include "wavelet/region_decoder.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis {

namespace {

/// Samples that go through the colour transform together: few enough for the cache.
constexpr size_t kChunk = 2048;

/// Components, of as many samples as `texels` has places, to interleaved samples.
void finish(const TextureHeader& header, int fraction_bits, std::span<int32_t* const> planes,
            uint32_t threads, Texels& texels) {
  const size_t count = size_t{texels.width} * texels.height;
  const int32_t most = (1 << texels.bits) - 1;
  const ColourTransform colour = colourOf(header);
  texels.samples.resize(count * planes.size());
  parallelFor(threads, (count + kChunk - 1) / kChunk, [&](size_t i) {
    const size_t first = i * kChunk, size = std::min(kChunk, count - first);
    std::vector<int32_t*> chunk(planes.size());
    for (size_t c = 0; c < planes.size(); ++c) chunk[c] = planes[c] + first;
    inverseColour(colour, chunk, size, fraction_bits);
    uint16_t* out = texels.samples.data() + first * planes.size();
    for (size_t c = 0; c < planes.size(); ++c) {
      for (size_t k = 0; k < size; ++k)
        out[k * planes.size() + c] = static_cast<uint16_t>(std::clamp(chunk[c][k], 0, most));
    }
  });
}

Texels emptyTexels(const TextureHeader& header, uint32_t width, uint32_t height) {
  return {width, height, header.channels, header.sample == TKS_U8 ? 8 : 16, {}};
}

}  // namespace

Texels decodeTexture(const TextureHeader& header, const Codewords& codewords, uint32_t threads) {
  Texels texels = emptyTexels(header, header.width, header.height);
  const size_t count = size_t{header.width} * header.height;
  const TexturePlan plan(header);
  std::vector<std::unique_ptr<int32_t[]>> planes(header.channels);
  std::vector<int32_t*> pointers;
  for (auto& plane : planes) {
    // One track fills the plane; of several some may be missing.
    plane.reset(header.regions.side_log2 == 0 ? new int32_t[count] : new int32_t[count]());
    pointers.push_back(plane.get());
  }
  const RegionDecoder tracks{header.wavelet, header.regions, header.planes, threads};
  const int fraction_bits = tracks.run(
      codewords, [&](size_t i) { return plan.bands(plan.parts(i)); },
      [&](size_t i, const TrackState& state, int more_bits) {
        const std::vector<BandPart> parts = plan.parts(i);
        for (size_t k = 0; k < state.bands.size(); ++k) {
          const BandPart& part = parts[k % parts.size()];
          scatter(state.bands[k], more_bits, plan.layout().subbands()[part.subband], part,
                  {pointers[k / parts.size()], count}, header.width);
        }
      });
  for (int32_t* plane : pointers) {
    inverseWavelet(specOf(header.wavelet), {plane, count}, header.width, header.height, {},
                   threads);
  }
  finish(header, fraction_bits, pointers, threads, texels);
  return texels;
}

Texels decodeTextureWindow(const TextureHeader& header, const Codewords& codewords,
                           const Window& window, uint32_t threads) {
  const TexturePlan plan(header);
  std::vector<WindowSynthesis> synthesis(
      header.channels, WindowSynthesis(specOf(header.wavelet), plan.layout().subbands(),
                                       header.width, header.height, window));
  const RegionDecoder tracks{header.wavelet, header.regions, header.planes, threads};
  const int fraction_bits = tracks.run(
      codewords,
      [&](size_t i) {
        const std::vector<BandPart> parts = plan.parts(i);
        const bool needed = std::any_of(parts.begin(), parts.end(), [&](const BandPart& part) {
          return synthesis.front().needs(part);
        });
        return needed ? plan.bands(parts) : std::vector<BandPlan>();
      },
      [&](size_t i, const TrackState& state, int more_bits) {
        const std::vector<BandPart> parts = plan.parts(i);
        for (size_t k = 0; k < state.bands.size(); ++k)
          synthesis[k / parts.size()].put(state.bands[k], more_bits, parts[k % parts.size()]);
      });
  std::vector<std::vector<int32_t>> planes(header.channels);
  parallelFor(threads, planes.size(), [&](size_t c) { planes[c] = synthesis[c].run({}); });
  std::vector<int32_t*> pointers;
  for (std::vector<int32_t>& plane : planes) pointers.push_back(plane.data());
  Texels texels = emptyTexels(header, window.width, window.height);
  finish(header, fraction_bits, pointers, threads, texels);
  return texels;
}

}  // namespace tetrakis
