// SPDX-License-Identifier: Apache-2.0
// Heights, validity and texels through the C interface: all of a level, or a window.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>

#include "api/decoder.hpp"
#include "api/memory.hpp"
#include "api/needed.hpp"
#include "api/written.hpp"
#include "texture_wavelet/texture_decoder.hpp"

namespace tetrakis::inline api {

namespace {

Status wrongSize(uint64_t wanted, uint64_t given) {
  return {TKS_USAGE, "The output takes " + std::to_string(wanted) + " bytes, the buffer has " +
                         std::to_string(given) + "."};
}

Status noTexture() {
  return {TKS_USAGE, "The stream holds no texture."};
}

/// The memory of the decoder for calls that ask for this view; null: there is none. Levels share
/// it, and so do windows: a part of a track that one has decoded is there for the others.
template <class Memory>
Memory* memoryOf(const tks_decoder& decoder, Memory& levels, Memory& windows, const View& view) {
  levels.tracks.all_levels = true;
  windows.tracks.tracks.most_bytes = decoder.most_of_windows;
  if (framesOf(decoder.parsed.header) > 1) {
    // All frames of the view are kept, whether or not their tracks are.
    levels.tracks.forgets = !decoder.remembers;
    windows.tracks.forgets = decoder.most_of_windows == 0;
    return view.window ? &windows : &levels;
  }
  if (view.window) return decoder.most_of_windows > 0 ? &windows : nullptr;
  return decoder.remembers ? &levels : nullptr;
}

}  // namespace

Status wrongIndex() {
  return {TKS_CORRUPT, "Corrupt stream: its index does not describe its packets."};
}

Status noMesh() {
  return {TKS_UNSUPPORTED, "Heights on a forest have meshes of tks_decode_mesh alone."};
}

Status noHeights() {
  return {TKS_USAGE, "The stream holds no heights."};
}

Status lost() {
  return {TKS_NO_MEMORY,
          "Memory was exhausted while the decoder took bytes: close it and open the stream anew."};
}

uint32_t framesOf(const StreamHeader& header) {
  if (header.geometry && !header.geometry->frames.none()) return header.geometry->frames.count;
  return header.texture ? header.texture->frames.shown() : 1;
}

void showScale(tks_decoder& decoder) {
  GeometryHeader& geometry = *decoder.parsed.header.geometry;
  const FrameScale scale = geometry.frames.scale(decoder.frame);
  geometry.base = decoder.base + static_cast<double>(scale.offset) * decoder.step;
  geometry.step = std::ldexp(decoder.step, scale.shift);
}

namespace {

/// The parts of a window of a cylinder, whose columns go on behind the last one with the first.
std::vector<Window> partsRound(const Window& window, uint32_t columns) {
  if (uint64_t{window.x} + window.width <= columns) return {window};
  const uint32_t before = columns - window.x;
  return {{window.x, window.y, before, window.height},
          {0, window.y, window.width - before, window.height}};
}

}  // namespace

Result<std::vector<View>> askedViews(const tks_decoder& decoder, tks_part part,
                                     const tks_window* window) {
  const StreamHeader& header = decoder.parsed.header;
  const bool texture = part == TKS_PART_TEXTURE;
  if (texture && !header.texture) return noTexture();
  if (!texture && !header.geometry) return noHeights();
  const int level = texture ? decoder.texture_level : decoder.heights_level;
  if (window == nullptr) {
    View whole = texture ? levelOf(*header.texture, level) : levelOf(*header.geometry, level);
    whole.frame = decoder.frame;
    return std::vector{whole};
  }
  const View all = texture ? levelOf(*header.texture, level) : levelOf(*header.geometry, level);
  const Extent extent = all.extentIn(texture ? header.texture->shown() : header.geometry->shown());
  const bool ring = texture ? header.texture->wavelet.ring : header.geometry->wavelet.ring;
  const Window asked{window->x, window->y, window->width, window->height};
  // A turn from the window's first column on.
  const Window inside{ring && asked.x < extent.width ? 0 : asked.x, asked.y, asked.width,
                      asked.height};
  if (!inside.isInside(extent))
    return Status(TKS_USAGE, "The window must lie inside the " + std::to_string(extent.width) +
                                 " x " + std::to_string(extent.height) +
                                 " samples and hold one or more.");
  std::vector<View> views;
  for (const Window& each : partsRound(asked, extent.width))
    views.push_back({level, each, decoder.frame, all.patch_rows});
  return views;
}

View decodedFor(const StreamHeader& header, tks_part part, const View& view) {
  if (!view.window || view.level == 0) return view;
  const auto decoded = [&](const auto& component, bool masked) {
    const bool lifted = !component.direct() && (component.wavelet.forest == nullptr || !masked) &&
                        component.frames.none() && component.repeats.none();
    return lifted ? view : View{view.level, {}, view.frame, view.patch_rows};
  };
  return part == TKS_PART_TEXTURE ? decoded(*header.texture, header.texture->alpha_bytes > 0)
                                  : decoded(*header.geometry, header.layers.validity_bytes > 0);
}

DecodedHeights decodeHeights(tks_decoder& decoder, const View& asked) {
  const StreamHeader& header = decoder.parsed.header;
  View view = asked;
  view.frame = decoder.frame;
  decoder.heights_windows.parts.most_bytes = decoder.most_of_windows;
  return decodeHeights(
      headerFor(decoder, *header.geometry, view), header.layers, heightTracksFor(decoder, view),
      view,
      {decoder.threads, memoryOf(decoder, decoder.heights_memory, decoder.heights_windows, view)});
}

Result<const DecodedHeights*> decodedHeights(tks_decoder& decoder) {
  const auto& geometry = decoder.parsed.header.geometry;
  if (!geometry) return noHeights();
  if (!decoder.heights)
    decoder.heights = decodeHeights(decoder, levelOf(*geometry, decoder.heights_level));
  return &*decoder.heights;
}

Result<const DecodedGeometry*> decodedGeometry(tks_decoder& decoder) {
  const Result<const DecodedHeights*> heights = decodedHeights(decoder);
  if (!heights.ok()) return heights.status();
  return &(*heights)->geometry;
}

namespace {

/// What a call asks for, and where it wants it.
struct Call {
  tks_part part;
  const tks_window* window;  ///< null, unless `windowed`: all of the level that is set
  bool windowed;             ///< there must be a window
  void* out;
  size_t bytes;

  Result<std::vector<View>> views(const tks_decoder& decoder) const {
    if (windowed && window == nullptr && askedViews(decoder, part, nullptr).ok())
      return Status(TKS_USAGE, "The window is missing.");
    return askedViews(decoder, part, window);
  }
};

/// The places of a view in a raster that several views make, beside each other.
struct ViewPlaces {
  size_t row_bytes, row_distance, rows;

  /// Puts rows that lie one behind the other where those of the view begin.
  void put(const std::byte* from, std::byte* to) const {
    for (size_t y = 0; y < rows; ++y)
      std::copy_n(from + y * row_bytes, row_bytes, to + y * row_distance);
  }
};

using Give = std::function<Status(const View& view, std::byte* out)>;

/// Writes the window of a view that is cut out of its level.
Status giveCut(const View& level, const View& view, Extent shown, size_t place_bytes,
               const Give& give, std::byte* out) {
  const Extent all = level.extentIn(shown);
  std::vector<std::byte> values(all.samples() * place_bytes);
  if (Status status = give(level, values.data()); !status.ok()) return status;
  const auto& [x, y, width, height] = *view.window;
  for (size_t row = 0; row < height; ++row) {
    const size_t from = ((y + row) * all.width + x) * place_bytes;
    std::copy_n(values.data() + from, width * place_bytes, out + row * width * place_bytes);
  }
  return {};
}

/// Writes what a call asks for, of so many bytes a place, one view after the other.
Status giveViews(tks_decoder& decoder, const Call& call, Extent shown, size_t place_bytes,
                 const Give& give) {
  const Result<std::vector<View>> views = call.views(decoder);
  if (!views.ok()) return views.status();
  size_t columns = 0;
  for (const View& view : *views) columns += view.extentIn(shown).width;
  const size_t row = columns * place_bytes, rows = views->front().extentIn(shown).height;
  if (call.out == nullptr) return outputMissing();
  if (call.bytes != row * rows) return wrongSize(row * rows, call.bytes);
  auto* to = static_cast<std::byte*>(call.out);
  for (const View& view : *views) {
    const ViewPlaces places{view.extentIn(shown).width * place_bytes, row, rows};
    const bool alone = views->size() == 1;
    const size_t copied = alone ? 0 : places.row_bytes * rows;
    if (Status s = checkMemory(decoder, {call.part, view, 0}, copied); !s.ok()) return s;
    std::vector<std::byte> part(copied);
    std::byte* const at = alone ? to : part.data();
    const View decoded = decodedFor(decoder.parsed.header, call.part, view);
    const Status given = decoded.window == view.window
                             ? give(view, at)
                             : giveCut(decoded, view, shown, place_bytes, give, at);
    if (!given.ok()) return given;
    if (!alone) places.put(part.data(), to);
    to += places.row_bytes;
  }
  return {};
}

/// How callers get heights: what writes decoded ones, and so many of which nothing was sent.
struct HeightsWriter {
  void (*decoded)(const tks_decoder& decoder, const DecodedHeights& heights, void* out);
  void (*unsent)(const tks_decoder& decoder, void* out, size_t count);
};

/// Writes heights of `sample_bytes` a sample. Heights of a whole level are kept for later calls.
Status giveHeights(tks_decoder& decoder, const Call& call, size_t sample_bytes,
                   const HeightsWriter& write) {
  const auto& header = decoder.parsed.header.geometry;
  const Extent shown = header ? header->shown() : Extent{};
  return giveViews(decoder, call, shown, sample_bytes, [&](const View& view, void* out) -> Status {
    if (heightsAreUnsent(decoder)) {
      write.unsent(decoder, out, view.extentIn(shown).samples());
    } else if (view.window) {
      write.decoded(decoder, decodeHeights(decoder, view), out);
    } else {
      const Result<const DecodedHeights*> decoded = decodedHeights(decoder);
      if (!decoded.ok()) return decoded.status();
      write.decoded(decoder, **decoded, out);
    }
    return {};
  });
}

Status giveSamples(tks_decoder& decoder, const Call& call) {
  const auto& header = decoder.parsed.header.geometry;
  const size_t sample_bytes =
      header ? tks_sample_bytes(static_cast<tks_sample>(header->sample)) : 0;
  return giveHeights(decoder, call, sample_bytes, {writeHeights, writeUnsentHeights});
}

Status giveSurface(tks_decoder& decoder, const Call& call) {
  const HeightsWriter write = {[](const tks_decoder& of, const DecodedHeights& heights, void* out) {
                                 writeSurface(of, heights, static_cast<float*>(out));
                               },
                               [](const tks_decoder& of, void* out, size_t count) {
                                 writeUnsentSurface(of, static_cast<float*>(out), count);
                               }};
  return giveHeights(decoder, call, sizeof(float), write);
}

Status giveValidity(tks_decoder& decoder, const Call& call) {
  const auto& geometry = decoder.parsed.header.geometry;
  const Extent shown = geometry ? geometry->shown() : Extent{};
  return giveViews(decoder, call, shown, 1, [&](const View& view, void* to) -> Status {
    std::vector<uint8_t> valid;
    if (decoder.heights && !view.window) {
      valid = decoder.heights->geometry.valid;
    } else if (!decoder.packets.payload.nothingOf(Component::kGeometry)) {
      const StreamHeader& header = decoder.parsed.header;
      const std::vector<bool> tracks = header.layers.region_masks
                                           ? neededTracks(header, Component::kGeometry, view)
                                           : std::vector<bool>{true};
      valid = decodeValidityLayer(*geometry, header.layers,
                                  decoder.packets.codewordsOf(Component::kGeometry, tracks), view);
    }
    auto* const out = static_cast<uint8_t*>(to);
    if (valid.empty()) {
      std::fill_n(out, view.extentIn(shown).samples(), uint8_t{1});
    } else {
      std::copy(valid.begin(), valid.end(), out);
    }
    return {};
  });
}

/// Of a view of a texture of which something was sent.
void giveTexels(tks_decoder& decoder, const View& view, size_t texel_bytes, std::byte* out) {
  const TextureHeader& header = *decoder.parsed.header.texture;
  const TextureHeader shown = headerFor(decoder, header, view);
  const Codewords codewords = decoder.packets.codewordsOf(
      Component::kTexture, neededTracks(decoder.parsed.header, Component::kTexture, view));
  TextureMemory* const memory =
      memoryOf(decoder, decoder.texture_memory, decoder.texture_windows, view);
  for (const View& strip : textureStrips(decoder, view)) {
    writeTexels(decodeTexture(shown, codewords, strip, {decoder.threads, memory}),
                static_cast<tks_sample>(header.sample), out);
    out += strip.extentIn(header.shown()).samples() * texel_bytes;
  }
}

Status giveTexels(tks_decoder& decoder, const Call& call) {
  const auto& header = decoder.parsed.header.texture;
  const Extent shown = header ? header->shown() : Extent{};
  const size_t texel_bytes =
      header ? tks_sample_bytes(static_cast<tks_sample>(header->sample)) * header->channels : 0;
  return giveViews(decoder, call, shown, texel_bytes, [&](const View& view, std::byte* out) {
    if (texelsAreUnsent(decoder)) {
      writeUnsentTexels(*header, out, view.extentIn(shown).samples());
    } else {
      giveTexels(decoder, view, texel_bytes, out);
    }
    return Status();
  });
}

Status checkLevel(const char* what, uint32_t level, int coarsest) {
  if (level <= static_cast<uint32_t>(coarsest)) return {};
  return {TKS_USAGE, std::string(what) + " have no level " + std::to_string(level) +
                         "; their coarsest is " + std::to_string(coarsest) + "."};
}

Status setLevels(tks_decoder& decoder, uint32_t heights, uint32_t texture) {
  const StreamHeader& header = decoder.parsed.header;
  if (heights > 0 && !header.geometry) return noHeights();
  if (texture > 0 && !header.texture) return noTexture();
  Status status = checkLevel("The heights", heights, coarsestLevelOf(header.geometry));
  if (status.ok()) status = checkLevel("The texels", texture, coarsestLevelOf(header.texture));
  if (!status.ok()) return status;
  if (static_cast<int>(heights) != decoder.heights_level) decoder.heights.reset();
  decoder.heights_level = static_cast<int>(heights);
  decoder.texture_level = static_cast<int>(texture);
  return {};
}

Status setFrame(tks_decoder& decoder, uint32_t frame) {
  StreamHeader& header = decoder.parsed.header;
  const uint32_t frames = framesOf(header);
  if (frame >= frames)
    return {TKS_USAGE, "The stream has no frame " + std::to_string(frame) + "; it has " +
                           std::to_string(frames) + ", from 0 on."};
  if (frame == decoder.frame) return {};
  decoder.frame = frame;
  decoder.heights.reset();
  if (header.geometry) showScale(decoder);
  return {};
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_set_frame(tks_decoder* decoder, uint32_t frame) {
  return tetrakis::keeping(decoder, [&] { return tetrakis::setFrame(*decoder, frame); });
}

tks_status tks_set_levels(tks_decoder* decoder, uint32_t heights, uint32_t texture) {
  return tetrakis::keeping(decoder,
                           [&] { return tetrakis::setLevels(*decoder, heights, texture); });
}

tks_status tks_decode_heights(tks_decoder* decoder, void* out, size_t bytes) {
  return tetrakis::keeping(decoder, [&] {
    return tetrakis::giveSamples(*decoder, {TKS_PART_HEIGHTS, nullptr, false, out, bytes});
  });
}

tks_status tks_decode_heights_window(tks_decoder* decoder, const tks_window* window, void* out,
                                     size_t bytes) {
  return tetrakis::keeping(decoder, [&] {
    return tetrakis::giveSamples(*decoder, {TKS_PART_HEIGHTS, window, true, out, bytes});
  });
}

tks_status tks_decode_surface(tks_decoder* decoder, float* out, size_t count) {
  return tetrakis::keeping(decoder, [&] {
    return tetrakis::giveSurface(*decoder,
                                 {TKS_PART_HEIGHTS, nullptr, false, out, count * sizeof(float)});
  });
}

tks_status tks_decode_surface_window(tks_decoder* decoder, const tks_window* window, float* out,
                                     size_t count) {
  return tetrakis::keeping(decoder, [&] {
    return tetrakis::giveSurface(*decoder,
                                 {TKS_PART_HEIGHTS, window, true, out, count * sizeof(float)});
  });
}

tks_status tks_decode_validity(tks_decoder* decoder, uint8_t* out, size_t count) {
  return tetrakis::keeping(decoder, [&] {
    return tetrakis::giveValidity(*decoder, {TKS_PART_VALIDITY, nullptr, false, out, count});
  });
}

tks_status tks_decode_validity_window(tks_decoder* decoder, const tks_window* window, uint8_t* out,
                                      size_t count) {
  return tetrakis::keeping(decoder, [&] {
    return tetrakis::giveValidity(*decoder, {TKS_PART_VALIDITY, window, true, out, count});
  });
}

tks_status tks_decode_texture(tks_decoder* decoder, void* out, size_t bytes) {
  return tetrakis::keeping(decoder, [&] {
    return tetrakis::giveTexels(*decoder, {TKS_PART_TEXTURE, nullptr, false, out, bytes});
  });
}

tks_status tks_decode_texture_window(tks_decoder* decoder, const tks_window* window, void* out,
                                     size_t bytes) {
  return tetrakis::keeping(decoder, [&] {
    return tetrakis::giveTexels(*decoder, {TKS_PART_TEXTURE, window, true, out, bytes});
  });
}
