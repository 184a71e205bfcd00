// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn/drawn_prefixes.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "codec/drawing/drawing_prefixes.hpp"
#include "texture_wavelet/drawn/drawn_fill.hpp"

namespace tetrakis::inline drawn {

namespace {

using ColourPrefixes = DrawingPrefixes<DrawnColours, DrawnColour>;

std::shared_ptr<ColourPrefixes> prefixesOf(const TextureHeader& header,
                                           std::span<const uint8_t> codeword,
                                           DrawnColours colours) {
  const std::vector<Level> levels = levelsOf(header.width, header.height);
  return std::make_shared<ColourPrefixes>(codeword, header.extent(), nullptr, levels,
                                          std::move(colours));
}

}  // namespace

std::function<Texels(uint64_t bytes)> prefixesOfDrawing(const TextureHeader& header,
                                                        std::span<const uint8_t> codeword) {
  Texels format = formatOf(header);
  const auto prefixes = prefixesOf(header, codeword, DrawnColours(format));
  format.samples.resize(header.extent().samples() * header.channels);
  return [prefixes, texels = std::move(format),
          levels = levelsOf(header.width, header.height)](uint64_t bytes) mutable {
    fillDrawn(levels, prefixes->indicesAfter(bytes), prefixes->list(), texels);
    return texels;
  };
}

std::function<DrawnOverlay(uint64_t bytes)> prefixesOfOverlay(const TextureHeader& header,
                                                              std::span<const uint8_t> codeword) {
  const auto prefixes = prefixesOf(header, codeword, overlayColours(formatOf(header)));
  return [prefixes](uint64_t bytes) {
    const std::span<const KeptIndex> known = prefixes->indicesAfter(bytes);
    DrawnOverlay overlay{ZeroedArray<KeptIndex>(known.size()), 1, prefixes->list()};
    std::copy(known.begin(), known.end(), overlay.indices.begin());
    return overlay;
  };
}

}  // namespace tetrakis::inline drawn
