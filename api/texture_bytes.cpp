// SPDX-License-Identifier: Apache-2.0
// textureStrips() cuts a view of a texture into strips, and textureBytes() counts the memory that
// decoding them takes.
#include "api/memory.hpp"

#include <algorithm>

#include "codec/lattice/validity.hpp"
#include "codec/lines/shown_lines.hpp"
#include "codec/wavelet/morphology.hpp"
#include "texture_wavelet/tables/channel_tables.hpp"

namespace tetrakis::inline api {

namespace {

/// Filters reach some rows into the strips beside them: in a smaller one these would count.
constexpr uint32_t kTexels = 1 << 20, kLeastRows = 64;

/// Whether one strip leaves to the next what it decoded.
bool areRemembered(const tks_decoder& decoder) {
  const TextureHeader& header = *decoder.parsed.header.texture;
  if (!decoder.remembers || header.direct()) return false;
  const uint64_t opening = header.alpha_bytes + header.overlay_bytes;
  return decoder.packets.bytesOf(Component::kTexture, 0) >= opening;
}

}  // namespace

std::vector<View> textureStrips(const tks_decoder& decoder, const View& view) {
  const TextureHeader& header = *decoder.parsed.header.texture;
  const uint32_t rows = std::max(kTexels / header.width, kLeastRows);
  const bool strips = view.isWhole() && header.frames.none() && rows < header.height &&
                      header.repeats.none() && header.wavelet.forest == nullptr &&
                      areRemembered(decoder);
  if (!strips) return {view};
  std::vector<View> views;
  for (uint32_t y = 0; y < header.height; y += rows)
    views.push_back({0, Window{0, y, header.width, std::min(rows, header.height - y)}});
  return views;
}

namespace {

class TextureBytes {
 public:
  TextureBytes(const tks_decoder& decoder, const View& view)
      : decoder_(decoder),
        header_(*decoder.parsed.header.texture),
        view_(decodedView(header_, codedView(header_, view))),
        cut_(view.window && !view_.window ? area(*view.window) : 0),
        shown_(area(view_.extentIn(header_.extent()))),
        copied_(header_.repeats.none() ? 0 : area(view.extentIn(header_.shown()))),
        seen_(header_.alpha_bytes > 0),
        masked_(header_.hidden || header_.overlay_bytes > 0) {}

  uint64_t decoding() const {
    return decodingLines() + cut_ * texel() + copyBytes(header_, copied_, texel());
  }

 private:
  uint64_t texel() const { return header_.channels * sizeof(uint16_t); }
  uint64_t decodingLines() const {
    const uint64_t out = shown_ * texel();
    if (header_.direct())
      return kDrawnOnceBytes + direct(view_.window ? area(header_) : shown_) +
             (view_.window ? out : 0);
    const uint32_t colour_planes = header_.colourPlanes() * header_.frames.shown();
    const PlanesBytes planes(decoder_, header_, view_, colour_planes, masked_);
    const uint64_t all = colour_planes * planes.coefficients;
    const uint64_t masks = shown_ * ((masked_ ? 1 : 0) + (seen_ ? 1 : 0));
    // A window's samples are apart from its coefficients, which are gone then.
    const uint64_t samples = view_.window ? colour_planes * kValueBytes * shown_ : all;
    const TrackNeeds needs =
        trackNeeds(decoder_, header_, colour_planes, masked_, Component::kTexture);
    const uint64_t state = stateBytes(decoder_, header_, view_, needs, Component::kTexture);
    const uint64_t once = header_.overlay_bytes > 0 ? kDrawnOnceBytes : kOnceBytes;
    return once + framesBytes(header_, planes, shown_, header_.colourPlanes()) + opening() +
           tableBytesOf(header_) + trackBytes(header_) +
           std::max({finding(), all + state, all + masks + planes.work, samples + masks + out});
  }
  /// The bytes that are held while a mask is decoded, or bridges are found.
  uint64_t finding() const {
    return std::max(seen_ ? validityBytes(header_.extent()) : 0,
                    bridged() ? closingBytes(header_.extent()) : 0);
  }
  bool bridged() const { return header_.bridge > 0; }
  uint64_t direct(uint64_t count) const {
    return count * ((header_.drawn() ? sizeof(DrawnIndex) : 0) + texel());
  }
  /// The bytes that the opening takes: a mask of the texels that can be seen, the colours of the
  /// overlay, a mask of the texels that are coded and one of those that are lifted, each of a whole
  /// plane.
  uint64_t opening() const {
    const uint64_t overlay = header_.overlay_bytes > 0 ? sizeof(DrawnIndex) : 0;
    const uint64_t masks = (seen_ ? 1u : 0u) + (masked_ ? 1u : 0u) + (bridged() ? 1u : 0u);
    return area(header_) * overlay + masks * BitPlane::bytesOf(header_.extent());
  }

  const tks_decoder& decoder_;
  const TextureHeader& header_;
  const View view_;
  uint64_t cut_;     ///< texels of the window that is cut out of a whole forest
  uint64_t shown_;   ///< texels of the view, of coded lines
  uint64_t copied_;  ///< of the view; 0: no lines are copied
  bool seen_, masked_;
};

}  // namespace

uint64_t textureBytes(const tks_decoder& decoder, const View& view) {
  uint64_t most = 0;
  for (const View& strip : textureStrips(decoder, view))
    most = std::max(most, TextureBytes(decoder, strip).decoding());
  return most;
}

}  // namespace tetrakis::inline api
