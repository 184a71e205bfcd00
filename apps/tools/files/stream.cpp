// SPDX-License-Identifier: Apache-2.0
// Streams (.tks) as the verbs read them, and what they decode to as files hold it.
#include "apps/tools/files/stream.hpp"

#include <algorithm>
#include <utility>

#include "apps/tools/files/cube_heights.hpp"
#include "apps/tools/files/file_bytes.hpp"
#include "apps/tools/files/memory_limit.hpp"

namespace tetrakis::tools {
namespace {

Status checkWhole(std::span<const uint8_t> bytes) {
  Result<Decoder> decoder = openDecoder(bytes);
  if (!decoder) return decoder.status();
  return decoder->verify();
}

/// given: six numbers of tks_info; window: what is decoded of the raster.
std::optional<GeoTransform> placedAt(const double* given, const std::optional<tks_window>& window) {
  GeoTransform transform;
  std::copy_n(given, transform.size(), transform.begin());
  return window ? movedTo(transform, window->x, window->y) : transform;
}

Result<std::vector<std::byte>> samplesOf(Decoder& decoder, const std::optional<tks_window>& window,
                                         uint64_t copies) {
  const Result<uint64_t> fits =
      decoder.checkMemory(TKS_PART_HEIGHTS, window ? &*window : nullptr, 0,
                          heightsBytes(decoder.info(), window) + copies);
  if (!fits) return fits.status();
  return window ? decoder.heights(*window) : decoder.heights();
}

/// Of heights on a cube, which are decoded whole.
Result<std::vector<std::byte>> gridSamples(Decoder& decoder,
                                           const std::optional<tks_window>& window,
                                           uint64_t copies) {
  const tks_info& info = decoder.info();
  const Extent all = shownHeights(info);
  const uint64_t asked = window ? uint64_t{window->width} * window->height : all.samples();
  const uint64_t floats = sizeof(float) * (uint64_t{info.width} * info.height + asked);
  const Result<uint64_t> fits = decoder.checkMemory(TKS_PART_HEIGHTS, nullptr, 0,
                                                    floats + heightsBytes(info, window) + copies);
  if (!fits) return fits.status();
  const Result<std::vector<float>> surface = decoder.surface();
  if (!surface) return surface.status();
  return gridOfCube(info, *surface, window);
}

}  // namespace

std::span<const uint8_t> octets(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
}

Result<Decoder> openDecoder(std::span<const uint8_t> bytes) {
  tks_limits limits = makeLimits();
  limits.max_samples = limits.max_texels = kMaxSamples;
  limits.max_memory = memoryLimit();
  return Decoder::open(bytes, limits);
}

Result<OpenStream> openStream(const StreamSource& source) {
  Result<std::vector<std::byte>> bytes = readBytes(source.path);
  if (!bytes.ok()) return bytes.status();
  if (source.strict)
    if (Status status = checkWhole(octets(*bytes)); !status.ok()) return status;
  if (source.bytes && *source.bytes < bytes->size()) bytes->resize(*source.bytes);
  Result<Decoder> decoder = openDecoder(octets(*bytes));
  if (!decoder) return decoder.status();
  const bool whole = bytes->size() == decoder->info().stream_bytes;
  if (const auto sound = whole ? decoder->verify() : Status(); !sound.ok()) return sound;
  return OpenStream{std::move(*bytes), std::move(*decoder)};
}

Result<OpenStream> openTerrain(const StreamSource& source) {
  Result<OpenStream> stream = openStream(source);
  if (stream.ok() && isObject(stream->decoder.info()))
    return Status(TKS_USAGE, quoted(source.path) +
                                 " holds an object, which has no ground: decode --mesh writes it");
  return stream;
}

Extent shownHeights(const tks_info& info) {
  return isGridOnCube(info) ? Extent{info.grid_width, info.grid_height}
                            : Extent{info.width, info.height};
}

uint64_t heightsBytes(const tks_info& info, const std::optional<tks_window>& window) {
  const Extent all = shownHeights(info);
  const uint64_t samples = window ? uint64_t{window->width} * window->height : all.samples();
  return samples * tks_sample_bytes(info.sample);
}

uint64_t imageBytes(const tks_info& info, const std::optional<tks_window>& window) {
  const uint64_t texels = window ? uint64_t{window->width} * window->height
                                 : uint64_t{info.texture_width} * info.texture_height;
  return texels * info.texture_channels * tks_sample_bytes(info.texture_sample);
}

Result<HeightFile> decodeHeights(Decoder& decoder, const std::optional<tks_window>& window,
                                 uint64_t copies) {
  const tks_info& info = decoder.info();
  if (!info.has_heights) return Status(TKS_USAGE, "the stream has no heights");
  Result<std::vector<std::byte>> samples = isGridOnCube(info) ? gridSamples(decoder, window, copies)
                                                              : samplesOf(decoder, window, copies);
  if (!samples) return samples.status();
  const Extent all = shownHeights(info);
  HeightFile file;
  file.width = window ? window->width : all.width;
  file.height = window ? window->height : all.height;
  file.sample = info.sample;
  file.data = std::move(*samples);
  file.scale = info.scale;
  file.offset = info.offset;
  file.spacing_x = info.spacing_x;
  file.spacing_y = info.spacing_y;
  file.unit = info.unit;
  file.vertical_datum = info.vertical_datum;
  file.crs = info.crs;
  file.description = info.description;
  file.registration = info.registration;
  file.geo_keys = info.geo_keys;
  if (info.has_geotransform) file.geotransform = placedAt(info.geotransform, window);
  if (info.has_nodata) file.nodata = info.nodata;
  return file;
}

Result<ImageFile> decodeImage(Decoder& decoder, const std::optional<tks_window>& window,
                              uint64_t copies) {
  const tks_info& info = decoder.info();
  if (!info.has_texture) return Status(TKS_USAGE, "the stream has no texture");
  const Result<uint64_t> fits = decoder.checkMemory(TKS_PART_TEXTURE, window ? &*window : nullptr,
                                                    0, imageBytes(info, window) + copies);
  if (!fits) return fits.status();
  Result<std::vector<std::byte>> texels = window ? decoder.texture(*window) : decoder.texture();
  if (!texels) return texels.status();
  ImageFile file;
  file.width = window ? window->width : info.texture_width;
  file.height = window ? window->height : info.texture_height;
  file.channels = info.texture_channels;
  file.sample = info.texture_sample;
  file.data = std::move(*texels);
  file.opaque = info.texture_opaque != 0;
  file.white_level = info.texture_white_level;
  file.place.registration = info.texture_registration;
  file.place.crs = info.texture_crs;
  file.place.geo_keys = info.texture_geo_keys;
  if (info.texture_has_geotransform)
    file.place.geotransform = placedAt(info.texture_geotransform, window);
  return file;
}

}  // namespace tetrakis::tools
