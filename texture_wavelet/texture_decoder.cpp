// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_decoder.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "bitstream/track_decoder.hpp"
#include "lattice/validity_decoder.hpp"
#include "texture_wavelet/drawn_decoder.hpp"
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
  const size_t count = size_t{texels.width} * texels.height, channels = texels.channels;
  const int32_t most = (1 << texels.bits) - 1;
  const ColourTransform colour = colourOf(header);
  std::vector<int32_t*> chunk(planes.size());
  for (size_t first = 0; first < count; first += kChunk) {
    const size_t size = std::min(kChunk, count - first);
    for (size_t c = 0; c < planes.size(); ++c) chunk[c] = planes[c] + first;
    inverseColour(colour, chunk, size, fraction_bits);
    uint16_t* out = texels.samples.data() + first * channels;
    for (size_t c = 0; c < planes.size(); ++c) {
      for (size_t i = 0; i < size; ++i)
        out[i * channels + c] = static_cast<uint16_t>(std::clamp(chunk[c][i], 0, most));
    }
  }
}

/// Alpha is the last channel.
void finishAlpha(std::span<const uint8_t> seen, Texels& texels) {
  const auto most = static_cast<uint16_t>((1 << texels.bits) - 1);
  for (size_t i = 0; i < seen.size(); ++i)
    texels.samples[(i + 1) * texels.channels - 1] = seen[i] != 0 ? most : uint16_t{0};
}

/// What the decoder knows of a texture track ahead of the inverse transform.
struct Coefficients {
  TrackState state;
  std::vector<uint8_t> seen;  ///< of all texels: 1 where alpha is not 0; empty: not a cut-out
};

Coefficients decodeCoefficients(const TextureHeader& header, const TexturePlan& plan,
                                const MipLevel& mip, std::span<const uint8_t> codeword) {
  std::vector<uint8_t> seen;
  if (header.alpha_bytes > 0) {
    const auto alpha = codeword.first(
        static_cast<size_t>(std::min<uint64_t>(header.alpha_bytes, codeword.size())));
    seen = decodeValidity(alpha, header.width, header.height);
    codeword = codeword.subspan(alpha.size());
  }
  std::vector<BandPlan> bands = plan.bands();
  const size_t each = plan.layout().size();
  for (size_t first = 0; first < bands.size(); first += each) {
    const auto component = std::span(bands).subspan(first, each);
    if (header.hidden) markAbsent(plan.layout(), seen, header.width, component);
    mip.dropFiner(component);
  }
  return {decodeTrack(bands, header.planes, codeword), std::move(seen)};
}

/// A component of the level, in the low band's array.
void restorePlane(const TextureHeader& header, const MipLevel& mip, std::span<const Band> bands,
                  int fraction_bits, Validity seen, std::span<int32_t> plane) {
  const auto [width, height] = mip.low();
  const std::vector<Subband> subbands = subbandsOf(width, height);
  for (size_t i = 0; i < subbands.size(); ++i) {
    scatter(bands[i], fraction_bits - header.wavelet.fraction_bits, subbands[i], plane, width);
  }
  const WaveletSpec spec = specOf(header.wavelet);
  inverseWavelet(mip.transform(spec), plane, width, height, seen);
  for (size_t i = 0; i < seen.size(); ++i) plane[i] *= seen[i];
  mip.normalise(spec, plane);
  mip.thin(plane);
}

}  // namespace

Texels decodeTexture(const TextureHeader& header, std::span<const uint8_t> codeword, int level) {
  if (header.drawn()) return decodeDrawn(header, codeword, level);
  const TexturePlan plan(header);
  const MipLevel mip(header.width, header.height, level);
  Coefficients known = decodeCoefficients(header, plan, mip, codeword);
  std::vector<uint8_t> seen = mip.maskOf(known.seen, header.width);
  known.seen.clear();
  const int fraction_bits = outputFractionBits(header.wavelet, header.planes, known.state.complete);
  const size_t count = size_t{mip.low().width} * mip.low().height, each = plan.layout().size();
  std::vector<std::unique_ptr<int32_t[]>> planes(header.components());
  std::vector<int32_t*> pointers;
  for (size_t c = 0; c < planes.size(); ++c) {
    planes[c].reset(new int32_t[count]);  // every value is written: the bands fill the plane
    pointers.push_back(planes[c].get());
    restorePlane(header, mip, std::span(known.state.bands).subspan(c * each, each), fraction_bits,
                 header.hidden ? Validity(seen) : Validity(), {planes[c].get(), count});
  }
  known.state.bands.clear();
  const auto [columns, rows] = mip.size();
  Texels texels{columns, rows, header.channels, header.sample == TKS_U8 ? 8 : 16, {}};
  texels.samples.resize(size_t{columns} * rows * header.channels);
  finish(header, fraction_bits, pointers, texels);
  if (!seen.empty()) {
    mip.thin(std::span(seen));
    finishAlpha(std::span(seen).first(mip.samples()), texels);
  }
  return texels;
}

}  // namespace tetrakis
