// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn/drawn_decoder.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/zeroed_array.hpp"
#include "codec/drawing/drawing_pass.hpp"
#include "texture_wavelet/drawn/drawn_interpolation.hpp"

namespace tetrakis::inline drawn {

namespace {

template <size_t kChannels>
void fillLevels(std::span<const Level> levels, std::span<const KeptIndex> indices,
                const DrawnColours& colours, const DrawnColour& grey, const DrawnPart& part) {
  uint16_t* const samples = part.samples;
  const auto known = [&](size_t texel) {
    const DrawnIndex index = indices[texel];
    if (index == kNoIndex) return false;
    std::copy_n(colours[index].begin(), kChannels, samples + texel * kChannels);
    return true;
  };
  for (const Level& level : levels)
    Interpolation<kChannels>(level, grey, part).run(known, [](size_t) {});
}

}  // namespace

DrawnColour greyOf(const Texels& format) {
  const auto half = static_cast<uint16_t>(1u << (format.bits - 1));
  return {half, half, half, half};
}

void fillDrawn(std::span<const Level> levels, std::span<const KeptIndex> indices,
               const DrawnColours& colours, Texels& texels) {
  const DrawnPart whole{
      texels.extent(), {0, 0, texels.width, texels.height}, texels.samples.data()};
  withChannels(texels.channels, [&]<size_t kChannels>() {
    fillLevels<kChannels>(levels, indices, colours, greyOf(texels), whole);
  });
}

void fillDrawn(std::span<const Level> levels, std::span<const KeptIndex> indices,
               const DrawnColours& colours, Extent whole, const Window& window, Texels& texels) {
  const uint32_t channels = texels.channels;
  ZeroedArray<uint16_t> samples(whole.samples() * channels);  // few of which are touched
  withChannels(channels, [&]<size_t kChannels>() {
    fillLevels<kChannels>(levels, indices, colours, greyOf(texels),
                          {whole, window, samples.data()});
  });
  texels.samples =
      slice(std::span<const uint16_t>(samples.data(), samples.size()),
            {whole.width * channels, whole.height},
            {0, Window{window.x * channels, window.y, window.width * channels, window.height}});
}

namespace {

using ColourDecoding = DrawingDecoding<DrawnColour>;

}  // namespace

Texels formatOf(const TextureHeader& header) {
  return {header.width, header.height, header.channels,   header.sample == TKS_U8 ? 8 : 16,
          {},           header.opaque, header.white_level};
}

DrawnColours overlayColours(const Texels& format) {
  DrawnColours colours(format);
  colours.add(greyOf(format));
  return colours;
}

/// Every 2^level-th texel is a grid of its own: no vertex needs one of a finer level.
Texels decodeDrawn(const TextureHeader& header, std::span<const uint8_t> codeword,
                   const View& view) {
  const std::vector<Level> levels = levelsOf(header.width, header.height, view.level);
  Texels texels = formatOf(header);
  const Extent grid = View{view.level, {}}.extentIn(header.extent());
  const Extent extent = view.extentIn(header.extent());
  texels.width = extent.width;
  texels.height = extent.height;
  ZeroedArray<KeptIndex> kept(grid.samples());
  const std::span<KeptIndex> indices(kept.data(), kept.size());
  DrawnColours colours(texels);
  ColourDecoding io(codeword);
  DrawingPass(PlaneView<KeptIndex>(indices, grid), nullptr, colours, io).run(levels);
  if (view.window) {
    fillDrawn(levels, indices, colours, grid, *view.window, texels);
  } else {
    texels.samples.resize(extent.samples() * header.channels);
    fillDrawn(levels, indices, colours, texels);
  }
  return texels;
}

DrawnOverlay decodeOverlay(const TextureHeader& header, std::span<const uint8_t> codeword) {
  DrawnOverlay overlay{ZeroedArray<KeptIndex>(header.extent().samples()), 1,
                       overlayColours(formatOf(header))};
  const PlaneView<KeptIndex> plane({overlay.indices.data(), overlay.indices.size()},
                                   header.extent());
  ColourDecoding io(codeword);
  overlay.step =
      DrawingPass(plane, nullptr, overlay.colours, io).run(levelsOf(header.width, header.height));
  return overlay;
}

}  // namespace tetrakis::inline drawn
