// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn/drawn_encoder.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "codec/drawing/drawing_encoding.hpp"
#include "codec/drawing/drawing_pass.hpp"
#include "codec/drawing/drawing_prefixes.hpp"
#include "texture_wavelet/drawn/drawn_decoder.hpp"
#include "texture_wavelet/drawn/drawn_interpolation.hpp"

namespace tetrakis::inline drawn {

namespace {

/// Fills the unknown texels and returns their squared error.
template <size_t kChannels>
uint64_t squaresOfUnknown(std::span<const Level> levels, std::span<const KeptIndex> indices,
                          const Texels& original, Texels& shown) {
  const DrawnColour grey = greyOf(shown);
  const uint16_t *const truth = original.samples.data(), *const seen = shown.samples.data();
  uint64_t squares = 0;
  const auto known = [indices](size_t texel) { return indices[texel] != kNoIndex; };
  const auto filled = [truth, seen, &squares](size_t texel) {
    for (size_t k = texel * kChannels; k < (texel + 1) * kChannels; ++k) {
      const auto off = static_cast<uint32_t>(int32_t{truth[k]} - seen[k]);
      squares += off * off;
    }
  };
  const DrawnPart whole{shown.extent(), {0, 0, shown.width, shown.height}, shown.samples.data()};
  for (const Level& level : levels) Interpolation<kChannels>(level, grey, whole).run(known, filled);
  return squares;
}

}  // namespace

double DrawnError::squares(std::span<const KeptIndex> indices) {
  std::copy(original_.samples.begin(), original_.samples.end(), shown_.samples.begin());
  uint64_t squares = 0;
  withChannels(original_.channels, [&]<size_t kChannels>() {
    squares = squaresOfUnknown<kChannels>(levels_, indices, original_, shown_);
  });
  return static_cast<double>(squares);
}

namespace {

/// An image looks drawn if one of this number of its texels is like a neighbour. A larger number
/// tries more drawings ahead of photographs, which takes time.
constexpr size_t kAlikePart = 2;

using NumberedColours = Numbered<DrawnColour>;
using ColourEncoding = DrawingEncoding<DrawnColour>;

/// seen_through: 1 for texels that get the number 0; empty: there are none.
std::optional<NumberedColours> number(const Texels& texels, std::span<const uint8_t> seen_through) {
  NumberedColours out;
  if (!seen_through.empty()) out.values.push_back(greyOf(texels));
  out.numbers.resize(size_t{texels.width} * texels.height);
  std::unordered_map<uint64_t, DrawnIndex> known;
  uint64_t last_key = 0;
  DrawnIndex last = kNoIndex;
  const uint16_t* from = texels.samples.data();
  for (size_t i = 0; i < out.numbers.size(); ++i) {
    DrawnColour colour{};
    uint64_t key = 0;
    for (uint32_t c = 0; c < texels.channels; ++c) {
      colour[c] = *from++;
      key = key << 16 | colour[c];
    }
    DrawnIndex& n = out.numbers[i];
    n = kSeeThrough;
    if (!seen_through.empty() && seen_through[i] != 0) continue;
    if (last == kNoIndex || key != last_key) {
      const auto [entry, added] =
          known.try_emplace(key, static_cast<DrawnIndex>(out.values.size()));
      if (added) {
        if (out.values.size() == kMostDrawnValues) return {};
        out.values.push_back(colour);
      }
      last_key = key;
      last = entry->second;
    }
    n = last;
  }
  return out;
}

bool looksDrawn(const NumberedColours& image, size_t width) {
  const std::vector<DrawnIndex>& n = image.numbers;
  size_t alike = 0;
  for (size_t i = 1; i < n.size(); ++i)
    alike += n[i] == n[i - 1] || (i >= width && n[i] == n[i - width]);
  return kAlikePart * alike >= n.size();
}

/// Noise has next to no texels like their neighbours, and dithers have few; where colours are few
/// their numbers still take fewer bits than what a wavelet makes of them.
bool mayFit(const NumberedColours& image, const Texels& texels, uint64_t bytes) {
  if (bytes == 0) return false;
  const PlaneView<const DrawnIndex> plane(image.numbers, texels.extent());
  return estimateDrawing(plane, Alone::kValue) <= static_cast<double>(bytes);
}

/// Codes the image into what `io` ends with.
void draw(const Texels& texels, std::vector<KeptIndex>& indices, DrawnColours& colours,
          ColourEncoding& io) {
  const PlaneView<KeptIndex> plane(indices, {texels.width, texels.height});
  DrawingPass(plane, nullptr, colours, io).run(levelsOf(texels.width, texels.height));
}

}  // namespace

std::optional<EncodedTexture> encodeDrawn(const Texels& texels, uint64_t most) {
  const std::optional<NumberedColours> image = number(texels, {});
  if (!image) return {};
  if (!looksDrawn(*image, texels.width) && !mayFit(*image, texels, most)) return {};
  std::vector<KeptIndex> indices(image->numbers.size());
  DrawnColours colours(texels);
  const std::vector<Level> levels = levelsOf(texels.width, texels.height);
  DrawnError error(texels, levels);
  ColourEncoding io(*image, 0, [&] { return error.squares(indices); });
  draw(texels, indices, colours, io);
  EncodedTexture encoded;
  encoded.header.width = texels.width;
  encoded.header.height = texels.height;
  encoded.header.channels = static_cast<uint8_t>(texels.channels);
  encoded.header.opaque = texels.opaque;
  encoded.header.white_level = texels.white_level;
  encoded.header.sample = texels.bits == 8 ? TKS_U8 : TKS_U16;
  encoded.header.planes = kDrawnPlanes;
  encoded.tracks.push_back(io.finishTrack(kDrawnPlanes));
  return encoded;
}

std::vector<uint8_t> encodeOverlay(const Texels& texels, Mask photograph) {
  const std::optional<NumberedColours> image = number(texels, photograph.bytes());
  assert(image.has_value());
  std::vector<KeptIndex> indices(image->numbers.size());
  DrawnColours colours(texels);
  colours.add(greyOf(texels));
  ColourEncoding io(*image, colours.size(), {});
  draw(texels, indices, colours, io);
  return io.finish();
}

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
