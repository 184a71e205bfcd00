// SPDX-License-Identifier: Apache-2.0
#include "texture_wavelet/texture_decoder.hpp"

#include <algorithm>
#include <cassert>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/forest.hpp"
#include "base/parallel.hpp"
#include "bitstream/coder/byte_planes.hpp"
#include "codec/frames/frame_reference.hpp"
#include "codec/lines/shown_lines.hpp"
#include "codec/wavelet/synthesis/view_synthesis.hpp"
#include "codec/wavelet/wavelet.hpp"
#include "texture_wavelet/colour/colour.hpp"
#include "texture_wavelet/drawn/drawn_decoder.hpp"
#include "texture_wavelet/tables/channel_tables.hpp"

namespace tetrakis::inline texture {

Texels decodeStoredTexture(const TextureHeader& header, std::span<const uint8_t> codeword,
                           const View& view) {
  const int bits = header.sampleBits();
  const uint32_t channels = header.channels;
  const Extent extent = view.extentIn(header.extent());
  Texels texels{extent.width, extent.height, channels, bits, {}, header.opaque, header.white_level};
  const BytePlanes words(codeword, header.extent().samples() * channels, bits / 8);
  const auto unknown = static_cast<uint16_t>((texels.white() + 1) / 2);
  texels.samples.reserve(extent.samples() * channels);
  for (uint32_t y = 0; y < extent.height; ++y) {
    const size_t row = size_t{view.rowOf(y)} * header.width;
    for (uint32_t x = 0; x < extent.width; ++x) {
      const size_t first = (row + view.firstColumn() + size_t{x} * view.step()) * channels;
      for (size_t i = first; i < first + channels; ++i)
        texels.samples.push_back(words.knows(i) ? static_cast<uint16_t>(words[i]) : unknown);
    }
  }
  return texels;
}

namespace {

/// Colour planes, of as many samples as `texels` has places, to interleaved samples.
void finish(const TextureHeader& header, int fraction_bits, std::span<std::vector<int32_t>> planes,
            uint32_t threads, Texels& texels) {
  const size_t count = texels.extent().samples(), channels = texels.channels;
  const int32_t most = texels.most();
  const ColourTransform colour = colourOf(header);
  const ChannelTables tables = channelTablesOf(header);
  texels.samples.resize(count * channels);
  parallelFor(threads, (count + kColourChunk - 1) / kColourChunk, [&](size_t i) {
    const size_t first = i * kColourChunk, size = std::min(kColourChunk, count - first);
    std::vector<int32_t*> chunk(planes.size());
    for (size_t c = 0; c < planes.size(); ++c) chunk[c] = planes[c].data() + first;
    inverseShears(colour, chunk, size);
    for (size_t c = 0; c < planes.size(); ++c) {
      const std::span channel(chunk[c], size);
      if (tables[c].empty()) {
        restoreSamples(channel, colour.centre[c], fraction_bits);
      } else {
        placesToSamples(tables[c], colour.centre[c], fraction_bits, channel);
      }
    }
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

Texels emptyTexels(const TextureHeader& header, Extent extent) {
  return {extent.width, extent.height, header.channels,   header.sample == TKS_U8 ? 8 : 16,
          {},           header.opaque, header.white_level};
}

/// The colour planes of a view, from their tracks.
class ColourPlanes {
 public:
  /// memory: of the tracks; null: there is none.
  ColourPlanes(const TextureHeader& header, const TextureOpening& opening, const View& view,
               TrackMemory* memory)
      : header_(header),
        opening_(opening),
        view_(view),
        plan_(header, opening.lifted, memory ? memory->norms : std::nullopt) {
    if (memory != nullptr) memory->norms = plan_.layout().norms();
    const ViewSynthesis empty(specOf(header.wavelet), pyramid(), view);
    synthesis_.assign(header.colourPlanes(), empty);
    for (ViewSynthesis& plane : synthesis_) plane.allocate();
  }

  int decode(const Codewords& coefficients, const DecodeContext<TrackMemory>& context) {
    const RegionDecoder tracks{header_.wavelet, header_.regions, header_.planes, view_.level,
                               context};
    const TrackBands bands{[&](size_t track) {
                             return neededParts(synthesis_.front(), plan_.layout().subbands(),
                                                plan_.regions()[track]);
                           },
                           [&](size_t track) { return plan_.bands(plan_.parts(track)); }};
    return tracks.run(
        coefficients, bands, [&](size_t track, const TrackState& state, int more_bits) {
          const std::vector<BandPart> parts = plan_.parts(track);
          for (size_t k = 0; k < state.bands.size(); ++k)
            synthesis_[k / parts.size()].put(state.bands[k], more_bits, parts[k % parts.size()]);
        });
  }

  /// Called once, when everything is decoded. memory: of each plane, or empty.
  std::vector<std::vector<int32_t>> restore(uint32_t threads, std::span<SynthesisMemory> memory) {
    inverseColourLevels(colourOf(header_), pyramid(), synthesis_);
    const std::vector<uint8_t> shown = shownMarks(opening_.coded, view_);
    std::vector<std::vector<int32_t>> planes(synthesis_.size());
    // A window's inverse transform knows no threads, that of a whole plane does.
    parallelFor(view_.window ? threads : 1, planes.size(), [&](size_t c) {
      planes[c] =
          memory.empty() ? synthesis_[c].run(threads) : synthesis_[c].run(threads, memory[c]);
      clearUnmarked(std::span(planes[c]), shown);
    });
    return planes;
  }

 private:
  const Pyramid& pyramid() const { return plan_.layout().pyramid(); }

  const TextureHeader& header_;
  const TextureOpening& opening_;
  const View& view_;
  TexturePlan plan_;
  std::vector<ViewSynthesis> synthesis_;  ///< of each colour plane
};

}  // namespace

uint64_t TextureMemory::bytes() const {
  uint64_t bytes = tracks.bytes() + frames.bytes();
  if (const TextureOpening* const whole = opening.whole.get()) {
    for (const SharedBits& marks : {whole->seen, whole->coded, whole->lifted})
      bytes += marks != nullptr ? BitPlane::bytesOf(marks->extent()) : 0;
    bytes += whole->overlay.indices.size() * sizeof(KeptIndex);
  }
  return bytes;
}

FrameLayout frameLayoutOf(const TextureHeader& header) {
  FrameLayout layout{header.extent(), header.frames, header.wavelet, header.regions, header.planes};
  layout.priorities.assign(header.priority.begin(),
                           header.priority.begin() + static_cast<int>(header.colourPlanes()));
  return layout;
}

namespace {

/// All frames of a view.
std::shared_ptr<const FramePlanes> framesOf(const TextureHeader& header, const Codewords& codewords,
                                            const View& view,
                                            const DecodeContext<TextureMemory>& context) {
  TextureMemory* const memory = context.memory;
  const uint64_t known = bytesOf(codewords);
  if (memory != nullptr && memory->frames.holds(view, known)) return memory->frames.planes;
  TrackMemory* const tracks = memory != nullptr ? &memory->tracks : nullptr;
  const FrameLayout layout = frameLayoutOf(header);
  const FramePlan plan(layout, nullptr, tracks != nullptr ? tracks->norms : std::nullopt);
  if (tracks != nullptr) tracks->norms = plan.layout().norms();
  const auto before = referenceOf(layout.frames);
  auto planes = std::make_shared<const FramePlanes>(
      decodeFramePlanes(layout, plan, codewords, view, before.get(), {context.threads, tracks}));
  if (memory != nullptr) memory->frames = {view, known, planes};
  return planes;
}

/// One frame of a texture in frames.
Texels decodeFrame(const TextureHeader& header, const Codewords& codewords, const View& view,
                   const DecodeContext<TextureMemory>& context) {
  const std::shared_ptr<const FramePlanes> all = framesOf(header, codewords, view, context);
  const auto first =
      all->planes.begin() + static_cast<ptrdiff_t>(view.frame * header.colourPlanes());
  std::vector<std::vector<int32_t>> planes(first, first + header.colourPlanes());
  Texels texels = emptyTexels(header, view.extentIn(header.extent()));
  finish(header, all->fraction_bits, planes, context.threads, texels);
  return texels;
}

}  // namespace

FrameReference lastFrame(const TextureHeader& header, const Codewords& codewords,
                         const DecodeContext<TextureMemory>& context) {
  const std::shared_ptr<const FramePlanes> all = framesOf(header, codewords, {}, context);
  FrameReference last;
  const size_t colours = header.colourPlanes();
  for (size_t p = all->planes.size() - colours; p < all->planes.size(); ++p)
    last.planes.push_back(wholeSteps(all->planes[p], all->fraction_bits));
  return last;
}

namespace {

/// A view of the lines that are coded.
Texels decodeLines(const TextureHeader& header, const Codewords& codewords, const View& view,
                   const DecodeContext<TextureMemory>& context) {
  TextureMemory* const memory = context.memory;
  if (memory != nullptr && memory->drawing) return memory->drawing(codewords.front().size());
  if (header.stored) return decodeStoredTexture(header, codewords.front(), view);
  if (header.drawn()) return decodeDrawn(header, codewords.front(), view);
  if (!header.frames.none()) return decodeFrame(header, codewords, view, context);
  Codewords coefficients = codewords;
  const auto opening =
      takeOpening(header, memory ? &memory->opening : nullptr, coefficients.front());
  const bool growing = memory != nullptr && memory->opening.whole != nullptr;
  TrackMemory* const tracks = growing ? &memory->tracks : nullptr;
  ColourPlanes colours(header, *opening, view, tracks);
  const int fraction_bits = colours.decode(coefficients, {context.threads, tracks});
  const std::span<SynthesisMemory> kept =
      memory ? std::span(memory->planes) : std::span<SynthesisMemory>();
  std::vector<std::vector<int32_t>> planes = colours.restore(context.threads, kept);
  Texels texels = emptyTexels(header, view.extentIn(header.extent()));
  finish(header, fraction_bits, planes, context.threads, texels);
  finishAlpha(shownMarks(opening->seen, view), texels);
  opening->paint(header.extent(), view, texels);
  return texels;
}

/// The texels of a view of a whole plane.
Texels viewOf(Texels texels, const View& view) {
  const Extent extent = view.extentIn(texels.extent());
  const size_t channels = texels.channels;
  std::vector<uint16_t> shown;
  shown.reserve(extent.samples() * channels);
  for (uint32_t y = 0; y < extent.height; ++y) {
    const size_t row = size_t{view.rowOf(y)} * texels.width + view.firstColumn();
    for (uint32_t x = 0; x < extent.width; ++x) {
      const uint16_t* const texel = &texels.samples[(row + size_t{x} * view.step()) * channels];
      shown.insert(shown.end(), texel, texel + channels);
    }
  }
  texels.samples = std::move(shown);
  texels.width = extent.width;
  texels.height = extent.height;
  return texels;
}

/// A window may be taken out of all texels, and a level of a drawing is, whose lattice is that of
/// the raster.
Texels decodeForest(const TextureHeader& header, const Codewords& codewords, const View& view,
                    const DecodeContext<TextureMemory>& context) {
  assert(view.level == 0 || view.patch_rows == header.wavelet.forest->side());
  const View decoded = header.drawn() ? View{} : decodedView(header, view);
  Texels texels = decodeLines(header, codewords, decoded, context);
  if (decoded.window) return texels;
  shareOwned(*header.wavelet.forest, std::span(texels.samples), texels.width - 1, texels.channels);
  if (decoded.extentIn(header.extent()) == view.extentIn(header.extent())) return texels;
  return viewOf(std::move(texels), view);
}

}  // namespace

View decodedView(const TextureHeader& header, const View& view) {
  return viewOnForest(header, view, !header.direct() && header.alpha_bytes == 0);
}

Texels decodeTexture(const TextureHeader& header, const Codewords& codewords, const View& view,
                     const DecodeContext<TextureMemory>& context) {
  assert(!codewords.empty());
  if (header.wavelet.forest != nullptr) return decodeForest(header, codewords, view, context);
  const ShownLines lines(header, view);
  Texels texels = decodeLines(header, codewords, lines.coded(), context);
  if (lines.none()) return texels;
  texels.samples = lines.shown(texels.samples, texels.channels);
  texels.width = static_cast<uint32_t>(lines.columns().size());
  texels.height = static_cast<uint32_t>(lines.rows().size());
  return texels;
}

}  // namespace tetrakis::inline texture
