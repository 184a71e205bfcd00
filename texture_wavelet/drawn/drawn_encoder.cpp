// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/drawn/drawn_encoder.hpp"

#include <cassert>
#include <unordered_map>
#include <vector>

#include "codec/drawing/drawing_encoding.hpp"
#include "codec/drawing/drawing_estimate.hpp"
#include "codec/drawing/drawing_pass.hpp"
#include "texture_wavelet/drawn/drawn_error.hpp"
#include "texture_wavelet/drawn/drawn_fill.hpp"

namespace tetrakis::inline drawn {

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

}  // namespace tetrakis::inline drawn
