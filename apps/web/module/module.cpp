// SPDX-License-Identifier: Apache-2.0
// What JavaScript calls beside tetrakis.h: it spares the loader (apps/web/src/instance.js) the
// layout of structs and numbers of 64 bits.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "apps/web/module/domains.hpp"
#include "base/samples.hpp"
#include "tetrakis/components.h"
#include "tetrakis/tetrakis.h"

extern "C" {

// What the loader calls each number of a stream, and the field of tks_info that holds it.
#define TKS_WEB_NUMBERS(NUMBER)                            \
  NUMBER(formatVersion, format_version)                    \
  NUMBER(profile, profile)                                 \
  NUMBER(level, level)                                     \
  NUMBER(headerBytes, header_bytes)                        \
  NUMBER(streamBytes, stream_bytes)                        \
  NUMBER(availableBytes, available_bytes)                  \
  NUMBER(packets, packets)                                 \
  NUMBER(geometryBytes, geometry_bytes)                    \
  NUMBER(textureBytes, texture_bytes)                      \
  NUMBER(hasHeights, has_heights)                          \
  NUMBER(hasTexture, has_texture)                          \
  NUMBER(width, width)                                     \
  NUMBER(height, height)                                   \
  NUMBER(coarsestLevel, coarsest_level)                    \
  NUMBER(sample, sample)                                   \
  NUMBER(scale, scale)                                     \
  NUMBER(offset, offset)                                   \
  NUMBER(step, step)                                       \
  NUMBER(spacingX, spacing_x)                              \
  NUMBER(spacingY, spacing_y)                              \
  NUMBER(lossless, lossless)                               \
  NUMBER(hasVoids, has_voids)                              \
  NUMBER(hasNodata, has_nodata)                            \
  NUMBER(nodata, nodata)                                   \
  NUMBER(maxError, max_error)                              \
  NUMBER(trianglesHint, triangles)                         \
  NUMBER(regions, regions)                                 \
  NUMBER(textureRegions, texture_regions)                  \
  NUMBER(textureWidth, texture_width)                      \
  NUMBER(textureHeight, texture_height)                    \
  NUMBER(textureChannels, texture_channels)                \
  NUMBER(textureCoarsestLevel, texture_coarsest_level)     \
  NUMBER(textureCutout, texture_cutout)                    \
  NUMBER(textureSample, texture_sample)                    \
  NUMBER(heightsRmse, heights_rmse)                        \
  NUMBER(texturePsnr, texture_psnr)                        \
  NUMBER(hasGeotransform, has_geotransform)                \
  NUMBER(g0, geotransform[0])                              \
  NUMBER(g1, geotransform[1])                              \
  NUMBER(g2, geotransform[2])                              \
  NUMBER(g3, geotransform[3])                              \
  NUMBER(g4, geotransform[4])                              \
  NUMBER(g5, geotransform[5])                              \
  NUMBER(registration, registration)                       \
  NUMBER(domain, domain)                                   \
  NUMBER(textureHasGeotransform, texture_has_geotransform) \
  NUMBER(t0, texture_geotransform[0])                      \
  NUMBER(t1, texture_geotransform[1])                      \
  NUMBER(t2, texture_geotransform[2])                      \
  NUMBER(t3, texture_geotransform[3])                      \
  NUMBER(t4, texture_geotransform[4])                      \
  NUMBER(t5, texture_geotransform[5])                      \
  NUMBER(textureRegistration, texture_registration)        \
  NUMBER(textureDomain, texture_domain)                    \
  NUMBER(textureOpaque, texture_opaque)                    \
  NUMBER(textureWhiteLevel, texture_white_level)           \
  NUMBER(voidsKnown, voids_known)                          \
  NUMBER(basePositionBits, base_mesh.position_bits)        \
  NUMBER(objectTriangles, object_triangles)                \
  NUMBER(frames, frames)                                   \
  NUMBER(frame, frame)                                     \
  NUMBER(components, components)                           \
  NUMBER(showsSketch, shows_sketch)                        \
  NUMBER(leastBytes, least_bytes) NUMBER(indexBytes, index_bytes)

/// The names, in the order in which web_numbers() writes the numbers.
const char* web_names() {
#define TKS_NAME(name, field) " " #name
  return &(TKS_WEB_NUMBERS(TKS_NAME))[1];  // without the first blank
#undef TKS_NAME
}

tks_status web_numbers(const tks_decoder* decoder, double* out) {
  tks_info info{};
  info.size = sizeof info;
  if (const tks_status status = tks_get_info(decoder, &info); status != TKS_OK) return status;
  const bool has_base = info.base_mesh.position_bits > 0;  // which six patches may be, too
  if (!has_base && isCube(info.forest)) info.domain = kCube;
  if (!has_base && isCube(info.texture_forest)) info.texture_domain = kCube;
#define TKS_VALUE(name, field) *out++ = static_cast<double>(info.field);
  TKS_WEB_NUMBERS(TKS_VALUE)
#undef TKS_VALUE
  return TKS_OK;
}

/// A text of the stream: 0 unit, 1 vertical datum, 2 CRS, 3 CRS of the texture, 4 GeoTIFF keys, 5
/// material.
const char* web_text(const tks_decoder* decoder, int which) {
  tks_info i{};
  i.size = sizeof i;
  if (tks_get_info(decoder, &i) != TKS_OK) return "";
  const char* const texts[] = {i.unit,        i.vertical_datum, i.crs,
                               i.texture_crs, i.geo_keys,       i.material};
  return which >= 0 && which < 6 ? texts[which] : "";
}

/// The name of a component of the stream; `out`: its kind, whether it is taken, its width, height
/// and bytes.
const char* web_component(const tks_decoder* decoder, uint32_t number, double* out) {
  tks_component one{};
  one.size = sizeof one;
  if (tks_get_component(decoder, number, &one) != TKS_OK) return "";
  const double numbers[] = {static_cast<double>(one.kind), static_cast<double>(one.is_taken),
                            static_cast<double>(one.width), static_cast<double>(one.height),
                            static_cast<double>(one.available_bytes)};
  std::copy_n(numbers, 5, out);
  return one.name;
}

/// How many bytes the positions of the heights or of the texture have; `out`: where these lie.
size_t web_positions(const tks_decoder* decoder, int texture, const uint8_t** out) {
  tks_info i{};
  i.size = sizeof i;
  if (tks_get_info(decoder, &i) != TKS_OK) return 0;
  *out = texture != 0 ? i.texture_positions : i.positions;
  return texture != 0 ? i.texture_positions_size : i.positions_size;
}

/// Texels of 1 to 4 channels as RGBA of 8 bits each, with what is white at white_level. Opaque ones
/// lose a further colour.
void web_rgba(const void* texels, uint8_t* out, size_t count, uint32_t channels, tks_sample sample,
              int opaque, uint32_t white_level) {
  const auto* const bytes = static_cast<const uint8_t*>(texels);
  const auto* const words = static_cast<const uint16_t*>(texels);
  const auto value = [&](size_t i, uint32_t white) {
    return sample == TKS_U16 ? tetrakis::shownIn8Bits(words[i], white) : bytes[i];
  };
  const bool colour = channels > 2, alpha = !opaque && channels % 2 == 0;
  for (size_t i = 0; i < count; ++i) {
    const size_t first = i * channels;
    out[4 * i] = value(first, white_level);
    out[4 * i + 1] = value(first + (colour ? 1 : 0), white_level);
    out[4 * i + 2] = value(first + (colour ? 2 : 0), white_level);
    out[4 * i + 3] = alpha ? value(first + channels - 1, UINT16_MAX) : 255;
  }
}

/// tks_put, with a place that JavaScript has as a number.
tks_status web_put(tks_decoder* decoder, double place, const uint8_t* data, size_t size) {
  return tks_put(decoder, static_cast<uint64_t>(place), data, size);
}

/// Whether bytes can come in any order.
int web_has_index(tks_decoder* decoder) {
  tks_info i{};
  i.size = sizeof i;
  return tks_get_info(decoder, &i) == TKS_OK && i.index != TKS_INDEX_NONE;
}

/// Begin, end and gain of each range, one after the other.
struct web_ranges {
  uint32_t count;
  double* numbers;  ///< to be freed
};

/// Takes the ranges over.
static tks_status give(tks_status status, tks_ranges* ranges, web_ranges* out) {
  *out = {};
  if (status != TKS_OK) return status;
  out->numbers = static_cast<double*>(std::malloc(3 * sizeof(double) * ranges->count + 1));
  if (out->numbers == nullptr) status = TKS_NO_MEMORY;
  for (size_t i = 0; i < ranges->count && status == TKS_OK; ++i) {
    const tks_range& range = ranges->ranges[i];
    out->numbers[3 * i] = static_cast<double>(range.offset);
    out->numbers[3 * i + 1] = static_cast<double>(range.offset + range.size);
    out->numbers[3 * i + 2] = range.gain;
    ++out->count;
  }
  tks_free_ranges(ranges);
  return status;
}

/// tks_plan. limits: those of tks_fetch in the order in which it has them; view: width and height
/// of the picture and 16 numbers; globe: what the view looks at; null: flat ground.
tks_status web_plan(tks_decoder* decoder, const double* limits, const double* view,
                    const tks_globe* globe, web_ranges* out) {
  tks_screen_camera camera{};
  camera.size = sizeof camera;
  camera.width = static_cast<uint32_t>(view[0]);
  camera.height = static_cast<uint32_t>(view[1]);
  std::copy_n(view + 2, 16, camera.clip);
  camera.globe = globe;
  const tks_fetch fetch = {sizeof fetch, static_cast<uint64_t>(limits[0]),
                           static_cast<uint32_t>(limits[1]), static_cast<uint64_t>(limits[2])};
  tks_ranges ranges{};
  const tks_status status = tks_plan(decoder, &camera, &fetch, &ranges);
  return give(status, &ranges, out);
}

/// tks_needed_ranges; gains are 0.
tks_status web_needed(tks_decoder* decoder, tks_part part, const tks_window* window,
                      web_ranges* out) {
  tks_ranges ranges{};
  return give(tks_needed_ranges(decoder, part, window, &ranges), &ranges, out);
}

}  // extern "C"
