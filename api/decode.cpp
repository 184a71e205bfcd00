// SPDX-License-Identifier: Apache-2.0
// Heights, validity and texels through the C interface: all of a level, or a window.
#include <algorithm>
#include <cmath>
#include <cstddef>
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

/// What the decoder remembers for calls that ask for this view; null: nothing. Levels share it, and
/// so do windows: what one decodes of the tracks others do not decode again.
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

Result<View> viewOf(const tks_decoder& decoder, tks_part part, const tks_window* window) {
  const StreamHeader& header = decoder.parsed.header;
  const bool texture = part == TKS_PART_TEXTURE;
  if (texture && !header.texture) return noTexture();
  if (!texture && !header.geometry) return noHeights();
  const int level = texture ? decoder.texture_level : decoder.heights_level;
  if (window == nullptr) return View{level, {}, decoder.frame};
  if (level > 0) return Status(TKS_USAGE, "Windows are parts of level 0; set the level to 0.");
  const Extent extent = texture ? header.texture->shown() : header.geometry->shown();
  const Window asked{window->x, window->y, window->width, window->height};
  if (asked.isInside(extent)) return View{0, asked, decoder.frame};
  return Status(TKS_USAGE, "The window must lie inside the " + std::to_string(extent.width) +
                               " x " + std::to_string(extent.height) +
                               " samples and hold one or more.");
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
  if (!decoder.parsed.header.geometry) return noHeights();
  if (!decoder.heights) decoder.heights = decodeHeights(decoder, {decoder.heights_level, {}});
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

  Result<View> view(const tks_decoder& decoder) const {
    if (windowed && window == nullptr && viewOf(decoder, part, nullptr).ok())
      return Status(TKS_USAGE, "The window is missing.");
    return viewOf(decoder, part, window);
  }
  /// The output takes as many bytes as so many places, and memory suffices.
  Status check(tks_decoder& decoder, const View& view, size_t places, size_t place_bytes) const {
    const size_t wanted = places * place_bytes;
    if (out == nullptr) return outputMissing();
    if (bytes != wanted) return wrongSize(wanted, bytes);
    return checkMemory(decoder, {part, view, 0});
  }
};

/// Writes heights of so many bytes a sample: all(decoded) from decoded ones, or unsent(count) if
/// nothing of them was sent. Those of whole levels are kept for later calls.
template <class All, class Unsent>
Status giveHeights(tks_decoder& decoder, const Call& call, size_t sample_bytes, const All& all,
                   const Unsent& unsent) {
  const Result<View> view = call.view(decoder);
  if (!view.ok()) return view.status();
  const size_t count = view->extentIn(decoder.parsed.header.geometry->shown()).samples();
  if (Status s = call.check(decoder, *view, count, sample_bytes); !s.ok()) return s;
  if (heightsAreUnsent(decoder)) {
    unsent(count);
  } else if (view->window) {
    all(decodeHeights(decoder, *view));
  } else {
    const Result<const DecodedHeights*> decoded = decodedHeights(decoder);
    if (!decoded.ok()) return decoded.status();
    all(**decoded);
  }
  return {};
}

Status giveSamples(tks_decoder& decoder, const Call& call) {
  const auto& header = decoder.parsed.header.geometry;
  const size_t sample_bytes =
      header ? tks_sample_bytes(static_cast<tks_sample>(header->sample)) : 0;
  return giveHeights(
      decoder, call, sample_bytes,
      [&](const DecodedHeights& decoded) { writeHeights(decoder, decoded, call.out); },
      [&](size_t count) { writeUnsentHeights(decoder, call.out, count); });
}

Status giveSurface(tks_decoder& decoder, const Call& call) {
  auto* const out = static_cast<float*>(call.out);
  return giveHeights(
      decoder, call, sizeof(float),
      [&](const DecodedHeights& decoded) { writeSurface(decoder, decoded, out); },
      [&](size_t count) { writeUnsentSurface(decoder, out, count); });
}

Status giveValidity(tks_decoder& decoder, const Call& call) {
  const Result<View> view = call.view(decoder);
  if (!view.ok()) return view.status();
  const StreamHeader& header = decoder.parsed.header;
  const size_t count = view->extentIn(header.geometry->shown()).samples();
  if (Status s = call.check(decoder, *view, count, 1); !s.ok()) return s;
  std::vector<uint8_t> valid;
  if (decoder.heights) {
    valid = decoder.heights->geometry.valid;
  } else if (!decoder.packets.payload.nothingOf(Component::kGeometry)) {
    valid = decodeValidityLayer(*header.geometry, header.layers,
                                decoder.packets.codewordsOf(Component::kGeometry, {true}), *view);
  }
  auto* const out = static_cast<uint8_t*>(call.out);
  if (valid.empty()) {
    std::fill_n(out, count, uint8_t{1});
  } else {
    std::copy(valid.begin(), valid.end(), out);
  }
  return {};
}

Status giveTexels(tks_decoder& decoder, const Call& call) {
  const Result<View> view = call.view(decoder);
  if (!view.ok()) return view.status();
  const TextureHeader& header = *decoder.parsed.header.texture;
  const auto sample = static_cast<tks_sample>(header.sample);
  const size_t count = view->extentIn(header.shown()).samples();
  const size_t texel_bytes = tks_sample_bytes(sample) * header.channels;
  if (Status s = call.check(decoder, *view, count, texel_bytes); !s.ok()) return s;
  if (texelsAreUnsent(decoder)) {
    writeUnsentTexels(header, call.out, count);
    return {};
  }
  const TextureHeader shown = headerFor(decoder, header, *view);
  const Codewords codewords = decoder.packets.codewordsOf(
      Component::kTexture, neededTracks(decoder.parsed.header, Component::kTexture, *view));
  TextureMemory* const memory =
      memoryOf(decoder, decoder.texture_memory, decoder.texture_windows, *view);
  auto* out = static_cast<std::byte*>(call.out);
  for (const View& strip : textureStrips(decoder, *view)) {
    writeTexels(decodeTexture(shown, codewords, strip, {decoder.threads, memory}), sample, out);
    out += strip.extentIn(header.shown()).samples() * texel_bytes;
  }
  return {};
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
