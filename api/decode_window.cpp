// SPDX-License-Identifier: Apache-2.0
// Windows of a stream, through the C interface (include/tetrakis/tetrakis.h).
#include <string>

#include "api/decoder.hpp"
#include "api/memory.hpp"
#include "api/written.hpp"
#include "texture_wavelet/texture_decoder.hpp"

namespace tetrakis {

namespace {

/// Where the caller wants what.
struct WindowRequest {
  const tks_window* window;
  void* out;
  size_t bytes;

  Window asked() const { return {window->x, window->y, window->width, window->height}; }
  size_t places() const { return size_t{window->width} * window->height; }

  /// part: of the stream, of width * height places, which holds it; sample_bytes: of what is
  /// written for each place.
  Status check(tks_decoder& decoder, tks_part part, const auto& header, size_t sample_bytes) const {
    const int level = part == TKS_PART_TEXTURE ? decoder.texture_level : decoder.heights_level;
    if (Status s = checkWindow(window, header.width, header.height, level); !s.ok()) return s;
    const size_t wanted = places() * sample_bytes;
    if (bytes != wanted || out == nullptr) return wrongSize(wanted, bytes);
    return checkMemory(decoder, {part, window, 0});
  }
};

DecodedHeights windowOf(const tks_decoder& decoder, const Window& window) {
  const StreamHeader& header = decoder.parsed.header;
  return decodeLayersWindow(decoder.payload.codewordsOf(Component::kGeometry), *header.geometry,
                            header.layers, window, decoder.threads);
}

Status heightsWindow(tks_decoder& decoder, const WindowRequest& request) {
  const auto& header = decoder.parsed.header.geometry;
  if (!header) return noHeights();
  const size_t sample_bytes = tks_sample_bytes(static_cast<tks_sample>(header->sample));
  if (Status s = request.check(decoder, TKS_PART_HEIGHTS, *header, sample_bytes); !s.ok()) return s;
  if (decoder.payload.nothingOf(Component::kGeometry)) {
    writeUnsentHeights(decoder, request.out, request.places());
  } else {
    writeHeights(decoder, windowOf(decoder, request.asked()), request.out);
  }
  return {};
}

Status surfaceWindow(tks_decoder& decoder, const WindowRequest& request) {
  const auto& header = decoder.parsed.header.geometry;
  if (!header) return noHeights();
  if (Status s = request.check(decoder, TKS_PART_HEIGHTS, *header, sizeof(float)); !s.ok())
    return s;
  auto* const out = static_cast<float*>(request.out);
  if (decoder.payload.nothingOf(Component::kGeometry)) {
    writeUnsentSurface(decoder, out, request.places());
  } else {
    writeSurface(decoder, windowOf(decoder, request.asked()), out);
  }
  return {};
}

Status textureWindow(tks_decoder& decoder, const WindowRequest& request) {
  const auto& header = decoder.parsed.header.texture;
  if (!header) return noTexture();
  const auto sample = static_cast<tks_sample>(header->sample);
  const size_t texel_bytes = tks_sample_bytes(sample) * header->channels;
  if (Status s = request.check(decoder, TKS_PART_TEXTURE, *header, texel_bytes); !s.ok()) return s;
  if (decoder.payload.nothingOf(Component::kTexture)) {
    writeUnsentTexels(*header, request.out, request.places());
  } else {
    writeTexels(decodeTextureWindow(*header, decoder.payload.codewordsOf(Component::kTexture),
                                    request.asked(), decoder.threads),
                sample, request.out);
  }
  return {};
}

}  // namespace

Status checkWindow(const tks_window* window, uint32_t width, uint32_t height, int level) {
  if (window == nullptr) return {TKS_USAGE, "The window is missing."};
  if (level > 0) return {TKS_USAGE, "Windows are parts of level 0; set the level to 0."};
  const tks_window& w = *window;
  const bool inside = w.width > 0 && w.height > 0 && w.width <= width && w.height <= height &&
                      w.x <= width - w.width && w.y <= height - w.height;
  if (inside) return {};
  return {TKS_USAGE, "The window must lie inside the " + std::to_string(width) + " x " +
                         std::to_string(height) + " samples and hold one or more."};
}

}  // namespace tetrakis

tks_status tks_decode_heights_window(tks_decoder* decoder, const tks_window* window, void* out,
                                     size_t bytes) {
  return tetrakis::keeping(decoder, [&] {
    return tetrakis::heightsWindow(*decoder, {window, out, bytes});
  });
}

tks_status tks_decode_surface_window(tks_decoder* decoder, const tks_window* window, float* out,
                                     size_t count) {
  return tetrakis::keeping(decoder, [&] {
    return tetrakis::surfaceWindow(*decoder, {window, out, count * sizeof(float)});
  });
}

tks_status tks_decode_texture_window(tks_decoder* decoder, const tks_window* window, void* out,
                                     size_t bytes) {
  return tetrakis::keeping(decoder, [&] {
    return tetrakis::textureWindow(*decoder, {window, out, bytes});
  });
}
