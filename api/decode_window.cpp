// SPDX-License-Identifier: Apache-2.0
// Windows of a stream, through the C interface (include/tetrakis/tetrakis.h).
#include <algorithm>
#include <limits>
#include <string>

#include "api/decoder.hpp"
#include "api/height_steps.hpp"
#include "api/samples.hpp"
#include "texture_wavelet/texture_decoder.hpp"

namespace tetrakis {

namespace {

/// Where the caller wants what.
struct WindowRequest {
  const tks_window* window;
  void* out;
  size_t bytes;

  Window asked() const { return {window->x, window->y, window->width, window->height}; }

  /// width, height: of the component; level: that the decoder is set to; sample_bytes: of what is
  /// written for each place.
  Status check(uint32_t width, uint32_t height, int level, size_t sample_bytes) const {
    if (window == nullptr) return {TKS_USAGE, "The window is missing."};
    if (level > 0) return {TKS_USAGE, "Windows are parts of level 0; set the level to 0."};
    const tks_window& w = *window;
    const bool inside = w.width > 0 && w.height > 0 && w.width <= width && w.height <= height &&
                        w.x <= width - w.width && w.y <= height - w.height;
    if (!inside) {
      return {TKS_USAGE, "The window must lie inside the " + std::to_string(width) + " x " +
                             std::to_string(height) + " samples and hold one or more."};
    }
    const size_t wanted = size_t{w.width} * w.height * sample_bytes;
    if (bytes == wanted && out != nullptr) return {};
    return {TKS_USAGE, "The output takes " + std::to_string(wanted) + " bytes, the buffer has " +
                           std::to_string(bytes) + "."};
  }
};

DecodedHeights windowOf(const tks_decoder& decoder, const Window& window) {
  const StreamHeader& header = decoder.parsed.header;
  return decodeLayersWindow(decoder.payload.codewordsOf(TrackId::kGeometry), *header.geometry,
                            header.layers, window, decoder.threads);
}

Status heightsWindow(const tks_decoder& decoder, const WindowRequest& request) {
  const StreamHeader& header = decoder.parsed.header;
  if (!header.geometry) return {TKS_USAGE, "The stream holds no heights."};
  const GeometryHeader& g = *header.geometry;
  const auto sample = static_cast<tks_sample>(g.sample);
  if (Status s = request.check(g.width, g.height, decoder.heights_level, tks_sample_bytes(sample));
      !s.ok())
    return s;
  const DecodedHeights decoded = windowOf(decoder, request.asked());
  fromSteps(decoded, g, header.layers, request.out);
  return {};
}

Status surfaceWindow(const tks_decoder& decoder, const WindowRequest& request) {
  const StreamHeader& header = decoder.parsed.header;
  if (!header.geometry) return {TKS_USAGE, "The stream holds no heights."};
  const GeometryHeader& g = *header.geometry;
  if (Status s = request.check(g.width, g.height, decoder.heights_level, sizeof(float)); !s.ok())
    return s;
  const DecodedGeometry geometry = windowOf(decoder, request.asked()).geometry;
  const SurfaceScale scale = surfaceScale(header, geometry);
  auto* out = static_cast<float*>(request.out);
  for (size_t i = 0; i < geometry.heights.size(); ++i) {
    const bool valid = geometry.valid.empty() || geometry.valid[i];
    out[i] = valid ? static_cast<float>(geometry.heights[i] * scale.scale + scale.offset)
                   : std::numeric_limits<float>::quiet_NaN();
  }
  return {};
}

Status textureWindow(const tks_decoder& decoder, const WindowRequest& request) {
  const auto& header = decoder.parsed.header.texture;
  if (!header) return {TKS_USAGE, "The stream holds no texture."};
  const auto sample = static_cast<tks_sample>(header->sample);
  const size_t texel_bytes = tks_sample_bytes(sample) * header->channels;
  if (Status s = request.check(header->width, header->height, decoder.texture_level, texel_bytes);
      !s.ok())
    return s;
  const Texels texels = decodeTextureWindow(*header, decoder.payload.codewordsOf(TrackId::kTexture),
                                            request.asked(), decoder.threads);
  withSampleType(sample, [&](auto type) {
    std::transform(texels.samples.begin(), texels.samples.end(),
                   static_cast<decltype(type)*>(request.out),
                   [](uint16_t v) { return static_cast<decltype(type)>(v); });
  });
  return {};
}

}  // namespace

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
