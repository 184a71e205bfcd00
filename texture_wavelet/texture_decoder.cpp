// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_decoder.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "base/parallel.hpp"
#include "texture_wavelet/colour/colour_levels.hpp"
#include "texture_wavelet/drawn/drawn_decoder.hpp"
#include "texture_wavelet/stored_texture.hpp"
#include "texture_wavelet/texture_plan.hpp"
#include "wavelet/mip_level.hpp"
#include "wavelet/wavelet_header.hpp"

namespace tetrakis {

namespace {

/// Components, of as many samples as `texels` has places, to interleaved samples.
void finish(const TextureHeader& header, int fraction_bits, std::span<int32_t* const> planes,
            uint32_t threads, Texels& texels) {
  const size_t count = size_t{texels.width} * texels.height, channels = texels.channels;
  const int32_t most = texels.most();
  const ColourTransform colour = colourOf(header);
  texels.samples.resize(count * channels);
  parallelFor(threads, (count + kColourChunk - 1) / kColourChunk, [&](size_t i) {
    const size_t first = i * kColourChunk, size = std::min(kColourChunk, count - first);
    std::vector<int32_t*> chunk(planes.size());
    for (size_t c = 0; c < planes.size(); ++c) chunk[c] = planes[c] + first;
    inverseColour(colour, chunk, size, fraction_bits);
    uint16_t* out = texels.samples.data() + first * channels;
    for (size_t c = 0; c < planes.size(); ++c) {
      for (size_t k = 0; k < size; ++k)
        out[k * channels + c] = static_cast<uint16_t>(std::clamp(chunk[c][k], 0, most));
    }
  });
}

/// Alpha is the last channel.
void finishAlpha(std::span<const uint8_t> seen, Texels& texels) {
  const uint16_t most = texels.most();
  for (size_t i = 0; i < seen.size(); ++i)
    texels.samples[(i + 1) * texels.channels - 1] = seen[i] != 0 ? most : uint16_t{0};
}

Texels emptyTexels(const TextureHeader& header, uint32_t width, uint32_t height) {
  return {width, height, header.channels, header.sample == TKS_U8 ? 8 : 16, {}};
}

/// What a track holds, and which bands of it a level needs; empty: none.
std::vector<BandPlan> planOf(const TexturePlan& plan, std::span<const BandPart> parts,
                             Validity coded, uint32_t width, const MipLevel& mip) {
  std::vector<BandPlan> bands = plan.bands(parts, coded, width);
  for (size_t first = 0; first < bands.size(); first += parts.size())
    mip.dropFiner(parts, std::span(bands).subspan(first, parts.size()));
  const auto needed = [](const BandPlan& band) { return band.needed; };
  if (std::none_of(bands.begin(), bands.end(), needed)) bands.clear();
  return bands;
}

/// The planes of a level, in the low band's arrays.
class Planes {
 public:
  /// filled: one track will fill the planes; else some or all of their coefficients stay 0.
  Planes(const TextureHeader& header, const MipLevel& mip, bool filled)
      : header_(header),
        mip_(mip),
        count_(size_t{mip.low().width} * mip.low().height),
        subbands_(subbandsOf(mip.low().width, mip.low().height)),
        planes_(header.components()) {
    for (auto& plane : planes_) {
      plane.reset(filled ? new int32_t[count_] : new int32_t[count_]());
      pointers_.push_back(plane.get());
    }
  }

  void put(const TrackState& state, std::span<const BandPart> parts, int more_bits) {
    for (size_t k = 0; k < state.bands.size(); ++k) {
      const BandPart& part = parts[k % parts.size()];
      if (part.subband >= subbands_.size()) continue;
      scatter(state.bands[k], more_bits, subbands_[part.subband], part,
              {pointers_[k / parts.size()], count_}, mip_.low().width);
    }
  }

  std::span<int32_t* const> restore(Validity coded, uint32_t threads) {
    const WaveletSpec spec = specOf(header_.wavelet);
    inverseColourLevels(colourOf(header_), subbands_, mip_.level(), pointers_, mip_.low().width);
    for (int32_t* plane : pointers_) {
      const std::span<int32_t> values(plane, count_);
      inverseWavelet(mip_.transform(spec), values, mip_.low().width, mip_.low().height, coded,
                     threads);
      for (size_t i = 0; i < coded.size(); ++i) plane[i] *= coded[i];
      mip_.normalise(spec, values);
      mip_.thin(values);
    }
    return pointers_;
  }

 private:
  const TextureHeader& header_;
  const MipLevel& mip_;
  size_t count_;
  std::vector<Subband> subbands_;
  std::vector<std::unique_ptr<int32_t[]>> planes_;
  std::vector<int32_t*> pointers_;
};

/// The shears of every level, of what a window needs.
void inverseWindowLevels(const ColourTransform& colour, std::span<const Subband> subbands,
                         std::span<WindowSynthesis> planes) {
  if (planes.size() < 3) return;
  for (const Subband& subband : subbands) {
    const uint32_t rows = planes.front().rows(subband);
    for (uint32_t row = 0; row < rows; ++row) {
      const auto values = planes[0].row(subband, row);
      inverseLevelColour(colour, subband.level,
                         std::array{values.data(), planes[1].row(subband, row).data(),
                                    planes[2].row(subband, row).data()},
                         values.size());
    }
  }
}

/// Of an image that is decoded whole.
Texels crop(const Texels& whole, const Window& window) {
  Texels part{window.width, window.height, whole.channels, whole.bits, {}};
  const size_t channels = whole.channels;
  for (uint32_t y = 0; y < window.height; ++y) {
    const auto from =
        whole.samples.begin() +
        static_cast<ptrdiff_t>((size_t{window.y + y} * whole.width + window.x) * channels);
    part.samples.insert(part.samples.end(), from,
                        from + static_cast<ptrdiff_t>(window.width * channels));
  }
  return part;
}

}  // namespace

Texels decodeTexture(const TextureHeader& header, const Codewords& codewords, int level,
                     uint32_t threads, TextureMemory* memory) {
  if (header.stored) return decodeStoredTexture(header, codewords.front(), level);
  if (header.drawn()) return decodeDrawn(header, codewords.front(), level);
  Codewords coefficients = codewords;
  const auto opening =
      takeOpening(header, memory ? &memory->opening : nullptr, coefficients.front());
  const TexturePlan plan(header);
  const MipLevel mip(header.width, header.height, level);
  const RegionDecoder tracks{header.wavelet, header.regions, header.planes, threads};
  Planes planes(header, mip, header.regions.side_log2 == 0 && !tracks.nothingKnown(coefficients));
  const Validity coded = opening->coded;
  const int fraction_bits = tracks.run(
      coefficients, [&](size_t i) { return planOf(plan, plan.parts(i), coded, header.width, mip); },
      [&](size_t i, const TrackState& state, int more_bits) {
        planes.put(state, plan.parts(i), more_bits);
      },
      memory == nullptr ? nullptr : &memory->track);
  const auto pointers = planes.restore(mip.maskOf(coded, header.width), threads);
  Texels texels = emptyTexels(header, mip.size().width, mip.size().height);
  finish(header, fraction_bits, pointers, threads, texels);
  std::vector<uint8_t> seen = mip.maskOf(opening->seen, header.width);
  if (!seen.empty()) {
    mip.thin(std::span(seen));
    finishAlpha(std::span(seen).first(mip.samples()), texels);
  }
  opening->paint(header.width, 0, 0, uint32_t{1} << level, texels);
  return texels;
}

Texels decodeTextureWindow(const TextureHeader& header, const Codewords& codewords,
                           const Window& window, uint32_t threads) {
  if (header.stored || header.drawn())
    return crop(decodeTexture(header, codewords, 0, threads), window);
  Codewords coefficients = codewords;
  const auto opening = takeOpening(header, nullptr, coefficients.front());
  const Validity coded = opening->coded;
  const TexturePlan plan(header);
  std::vector<WindowSynthesis> synthesis(
      header.components(), WindowSynthesis(specOf(header.wavelet), plan.layout().subbands(),
                                           header.width, header.height, window));
  for (WindowSynthesis& component : synthesis) component.allocate();
  const RegionDecoder tracks{header.wavelet, header.regions, header.planes, threads};
  const int fraction_bits = tracks.run(
      coefficients,
      [&](size_t i) {
        const std::vector<BandPart> parts = plan.parts(i);
        const bool needed = std::any_of(parts.begin(), parts.end(), [&](const BandPart& part) {
          return synthesis.front().needs(part);
        });
        return needed ? plan.bands(parts, coded, header.width) : std::vector<BandPlan>();
      },
      [&](size_t i, const TrackState& state, int more_bits) {
        const std::vector<BandPart> parts = plan.parts(i);
        for (size_t k = 0; k < state.bands.size(); ++k)
          synthesis[k / parts.size()].put(state.bands[k], more_bits, parts[k % parts.size()]);
      });
  inverseWindowLevels(colourOf(header), plan.layout().subbands(), synthesis);
  const auto cropped = [&](std::span<const uint8_t> mask) {
    return mask.empty() ? std::vector<uint8_t>() : crop(mask, header.width, window);
  };
  const std::vector<uint8_t> inside = cropped(coded);
  std::vector<std::vector<int32_t>> planes(header.components());
  parallelFor(threads, planes.size(), [&](size_t c) {
    planes[c] = synthesis[c].run(coded);
    for (size_t i = 0; i < inside.size(); ++i) planes[c][i] *= inside[i];
  });
  std::vector<int32_t*> pointers;
  for (std::vector<int32_t>& plane : planes) pointers.push_back(plane.data());
  Texels texels = emptyTexels(header, window.width, window.height);
  finish(header, fraction_bits, pointers, threads, texels);
  finishAlpha(cropped(opening->seen), texels);
  opening->paint(header.width, window.x, window.y, 1, texels);
  return texels;
}

}  // namespace tetrakis
