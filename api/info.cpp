// SPDX-License-Identifier: Apache-2.0
// What a stream, or a prefix of one, says about itself, and whether it is whole.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "api/decoder.hpp"
#include "api/guarded.hpp"
#include "api/triangle_object.hpp"
#include "base/coordinates.hpp"
#include "bitstream/stream/georeference.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis::inline api {

namespace {

/// Whether the records of index pages, which follow the stream, list its packets.
Status verifyPages(const tks_decoder& decoder) {
  PageIndex pages = *PageIndex::of(decoder.parsed);
  const auto [begin, end] = pages.records();
  if (decoder.data.size() < end) {
    return {TKS_TRUNCATED, "The index of the stream ends at byte " +
                               std::to_string(decoder.data.size()) + " of " + std::to_string(end) +
                               "."};
  }
  for (const uint32_t page : pages.pagesIn({begin, end})) {
    const auto [from, to] = pages.record(page);
    const Status status = pages.take(page, decoder.data.subspan(from, to - from));
    if (!status.ok()) return status;
  }
  std::vector<size_t> passed(pages.grid().pages());  // packets of each page
  uint64_t at = decoder.parsed.bytes;
  for (const PacketHead& head : decoder.packets.payload.heads) {
    const uint32_t page = pages.grid().pageOf(head.track);
    const std::vector<PagedPacket>& listed = pages.packets(page);
    if (passed[page] == listed.size()) return wrongIndex();
    PagedPacket packet = listed[passed[page]++];
    packet.head.quality = head.quality;  // which pages do not state
    if (packet.begin != at || packet.head != head) return wrongIndex();
    at = packet.end();
  }
  return pages.knownPackets() == decoder.packets.payload.heads.size() ? Status() : wrongIndex();
}

Status verify(const tks_decoder& decoder) {
  if (decoder.sketched)
    return {TKS_TRUNCATED, "The stream ends inside its header, at byte " +
                               std::to_string(decoder.sketched->all.size()) + " of " +
                               std::to_string(decoder.sketched->stream_bytes) + "."};
  const StreamHeader& header = decoder.parsed.header;
  const uint64_t total = decoder.parsed.bytes + header.payload_bytes;
  if (decoder.data.size() < total) {
    return {TKS_TRUNCATED, "The stream ends at byte " + std::to_string(decoder.data.size()) +
                               " of " + std::to_string(total) + "."};
  }
  const uint64_t end = decoder.pages ? decoder.pages->records().end : total;
  if (decoder.data.size() > end) {
    return {TKS_CORRUPT, "Corrupt stream: " + std::to_string(decoder.data.size() - end) +
                             " bytes follow its end at byte " + std::to_string(end) + "."};
  }
  if (decoder.data.size() > total)
    if (Status pages = verifyPages(decoder); !pages.ok()) return pages;
  const std::span<const uint8_t> payload =
      decoder.data.subspan(decoder.parsed.bytes, header.payload_bytes);
  if (header.payload_crc && *header.payload_crc != crc32(payload))
    return {TKS_CORRUPT, "The stream is damaged: the checksum of its payload does not match."};
  return header.triangle_mesh.none() ? Status() : checkTriangles(decoder);
}

void fillQuality(const tks_decoder& decoder, tks_info& info) {
  const StreamHeader& header = decoder.parsed.header;
  info.heights_rmse = info.texture_psnr = -1;
  auto qualities = decoder.packets.payload.quality;
  if (header.lossless && header.payload_bytes == 0) qualities.fill(0);  // there was nothing to send
  if (const auto quality = qualities[0]; quality && header.geometry)
    info.heights_rmse = rmseOf(*quality) * header.geometry->step * std::abs(header.metadata.scale);
  if (const auto quality = qualities[1]; quality && header.texture) {
    const double peak = header.texture->white();
    const double rmse = rmseOf(*quality);
    info.texture_psnr =
        rmse == 0 ? std::numeric_limits<double>::infinity() : 20 * std::log10(peak / rmse);
  }
}

uint32_t sideOf(const RegionHeader& regions) {
  return regions.side_log2 == 0 ? 0 : uint32_t{1} << regions.side_log2;
}

/// tks_info::heights_drawn and texture_drawn.
enum Coding : int { kByWavelet = 0, kDrawn = 1, kOverlaid = 2, kStored = 3 };

Coding codingOf(const GeometryHeader& heights) {
  return heights.drawn ? kDrawn : heights.stored() ? kStored : kByWavelet;
}

Coding codingOf(const TextureHeader& texture) {
  if (texture.direct()) return texture.stored ? kStored : kDrawn;
  return texture.overlay_bytes > 0 ? kOverlaid : kByWavelet;
}

int giveTransform(const Placement& placement, int level, double* out) {
  if (placement.has_transform) {
    const GeoTransform transform = atLevel(placement.transform, level);
    std::copy(transform.begin(), transform.end(), out);
  }
  return placement.has_transform;
}

/// Whether the last column is the first one again, on a grid in a usual unit of angles.
bool repeatsColumn(const PlacedRaster& grid) {
  constexpr double kInDegrees[] = {1, 180 / std::numbers::pi, 0.9};  // radians, gons
  return std::any_of(std::begin(kInDegrees), std::end(kInDegrees), [&](double degrees) {
    return columnsRound(grid, degrees) == ColumnsRound::kRepeating;
  });
}

/// The grid that heights on a forest come from: of fewer samples at higher levels, on the same
/// ground but for a repeated column.
void fillGrid(const tks_decoder& decoder, tks_info& info) {
  const StreamHeader& header = decoder.parsed.header;
  if (!header.geometry || header.geometry->wavelet.forest == nullptr) return;
  info.grid_width = header.grid.width;
  info.grid_height = header.grid.height;
  const Placement& place = header.georeference.heights;
  if (place.has_transform)
    std::copy(place.transform.begin(), place.transform.end(), info.geotransform);
  if (decoder.heights_level == 0 || info.grid_width == 0) return;
  const auto fewer = [&](uint32_t samples) { return ((samples - 1) >> decoder.heights_level) + 1; };
  const bool repeats =
      place.has_transform && repeatsColumn({info.grid_width, info.grid_height, info.geotransform});
  const uint32_t round = info.grid_width - repeats;
  info.grid_width = fewer(round);
  info.grid_height = std::max(fewer(header.grid.height), 2u);
  for (const size_t i : {1, 4})
    info.geotransform[i] *= static_cast<double>(round) / info.grid_width;
  for (const size_t i : {2, 5})
    info.geotransform[i] *= static_cast<double>(header.grid.height) / info.grid_height;
}

void fillGeoreference(const tks_decoder& decoder, tks_info& info) {
  const Georeference& place = decoder.parsed.header.georeference;
  if (!info.has_nodata && place.nan_nodata) {
    info.has_nodata = 1;
    info.nodata = std::numeric_limits<double>::quiet_NaN();
  }
  info.has_geotransform = giveTransform(place.heights, decoder.heights_level, info.geotransform);
  info.registration = static_cast<tks_registration>(place.heights.registration);
  info.description = place.description.c_str();
  info.geo_keys = place.heights.geo_keys.c_str();
  info.texture_has_geotransform =
      giveTransform(place.texture, decoder.texture_level, info.texture_geotransform);
  info.texture_registration = static_cast<tks_registration>(place.texture.registration);
  const bool shared = place.texture.has_transform && !place.hasTextureCrs();
  info.texture_crs = shared ? info.crs : place.texture_crs.c_str();
  info.texture_geo_keys = shared ? info.geo_keys : place.texture.geo_keys.c_str();
}

struct PositionBytes {
  const uint8_t* data = nullptr;
  size_t size = 0;
};

/// As they stand in the stream, if they are of the form that is known.
PositionBytes positionsIn(const std::string& bytes) {
  if (!groundPositionsIn(bytes)) return {};
  return {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
}

void fillPositions(const tks_decoder& decoder, tks_info& info) {
  const PositionBytes heights = positionsIn(decoder.parsed.header.height_positions);
  const PositionBytes texture = positionsIn(decoder.parsed.header.texture_positions);
  info.positions = heights.data;
  info.positions_size = heights.size;
  info.texture_positions = texture.data;
  info.texture_positions_size = texture.size;
}

/// The stream as a whole.
void fillStream(const tks_decoder& decoder, tks_info& info) {
  const StreamHeader& header = decoder.parsed.header;
  info.format_version = header.version;
  info.profile = header.profile;
  info.level = header.level;
  info.header_bytes = info.least_bytes = decoder.parsed.bytes;
  info.stream_bytes = decoder.parsed.bytes + header.payload_bytes;
  info.available_bytes = decoder.data.size();
  if (decoder.pages) info.available_bytes = std::min(info.available_bytes, info.stream_bytes);
  if (const auto& sketched = decoder.sketched) {
    info.shows_sketch = 1;
    info.header_bytes = sketched->header_bytes;
    info.stream_bytes = sketched->stream_bytes;
    info.available_bytes = sketched->all.size();
  }
  if (decoder.sketched || !header.sketch.empty())
    info.least_bytes = *leastBytes(decoder.sketched ? decoder.sketched->all : decoder.data);
  info.packets = decoder.packets.payload.heads.size();
  info.geometry_bytes = decoder.packets.payload.bytes[0];
  info.texture_bytes = decoder.packets.payload.bytes[1];
  info.has_heights = header.geometry.has_value();
  info.has_texture = header.texture.has_value();
  info.lossless = header.lossless;
  info.triangles = header.triangles;
  info.object_triangles = static_cast<uint32_t>(header.triangle_mesh.triangles);
  info.index = decoder.index;
  if (decoder.pages)
    info.index_bytes = decoder.pages->records().end - decoder.pages->records().begin;
  info.components = static_cast<uint32_t>(header.components.size());
  info.material = header.material.c_str();
}

/// Encoders may leave out up to four bytes at the end of a codeword, which its decoder reads ahead
/// of what it decides.
bool voidsAreKnown(const tks_decoder& decoder) {
  constexpr uint64_t kReadAhead = 4;
  const uint64_t known = decoder.packets.bytesOf(Component::kGeometry, 0);
  const uint64_t ahead = isComplete(decoder) ? kReadAhead : 0;
  return known + ahead >= decoder.parsed.header.layers.maskEnd();
}

/// Of either component.
template <class Header>
tks_domain domainOf(const Header& header) {
  if (header.wavelet.forest != nullptr) return TKS_DOMAIN_FOREST;
  return header.wavelet.ring ? TKS_DOMAIN_CYLINDER : TKS_DOMAIN_PLANE;
}

tks_forest forestOf(const SharedForest& forest, int level) {
  if (forest == nullptr) return {};
  return {static_cast<uint32_t>(forest->depth() - level), forest->patches(),
          forest->sides().data()};
}

tks_base_mesh baseMeshOf(const BaseMesh& mesh) {
  static_assert(sizeof(Cell) == 3 * sizeof(int32_t));
  tks_base_mesh out = {static_cast<uint32_t>(mesh.bits), mesh.cell, {}, mesh.corners[0].data()};
  std::copy(mesh.origin.begin(), mesh.origin.end(), out.origin);
  return out;
}

void fillHeights(const tks_decoder& decoder, tks_info& info) {
  const StreamHeader& header = decoder.parsed.header;
  info.max_error = -1;
  if (!header.geometry) return;
  const GeometryHeader& geometry = *header.geometry;
  const Extent shown = levelOf(geometry, decoder.heights_level).extentIn(geometry.shown());
  info.width = shown.width;
  info.height = shown.height;
  info.coarsest_level = static_cast<uint32_t>(coarsestLevelOf(header.geometry));
  info.regions = sideOf(geometry.regions);
  info.sample = static_cast<tks_sample>(geometry.sample);
  info.base = geometry.base;
  info.step = geometry.step;
  info.exact_steps = geometry.exact;
  info.max_error = geometry.max_error;
  info.heights_drawn = codingOf(geometry);
  info.has_voids = header.layers.validity_bytes > 0;
  info.voids_known = header.layers.region_masks ? info.available_bytes >= info.stream_bytes
                                                : voidsAreKnown(decoder);
  info.has_nodata = header.layers.has_nodata;
  info.nodata = header.layers.nodata;
  info.domain = domainOf(geometry);
  info.forest = forestOf(geometry.wavelet.forest, decoder.heights_level);
  if (decoder.base_mesh) info.base_mesh = baseMeshOf(*decoder.base_mesh);
}

void fillTexture(const tks_decoder& decoder, tks_info& info) {
  const StreamHeader& header = decoder.parsed.header;
  if (!header.texture) return;
  const TextureHeader& texture = *header.texture;
  const Extent shown = levelOf(texture, decoder.texture_level).extentIn(texture.shown());
  info.texture_width = shown.width;
  info.texture_height = shown.height;
  info.texture_coarsest_level = static_cast<uint32_t>(coarsestLevelOf(header.texture));
  info.texture_regions = sideOf(texture.regions);
  info.texture_channels = texture.channels;
  info.texture_opaque = !texture.hasAlpha();
  info.texture_white_level = texture.white();
  info.texture_cutout = texture.alpha_bytes > 0 ? 1 + texture.hidden : 0;
  info.texture_drawn = codingOf(texture);
  info.texture_sample = static_cast<tks_sample>(texture.sample);
  info.texture_domain = domainOf(texture);
  info.texture_forest = forestOf(texture.wavelet.forest, decoder.texture_level);
}

void fillFrames(const tks_decoder& decoder, tks_info& info) {
  info.frames = framesOf(decoder.parsed.header);
  info.frame = decoder.frame;
}

void fillMetadata(const tks_decoder& decoder, tks_info& info) {
  const Metadata& m = decoder.parsed.header.metadata;
  info.scale = m.scale;
  info.offset = m.offset;
  info.spacing_x = std::ldexp(m.spacing_x, decoder.heights_level);
  info.spacing_y = std::ldexp(m.spacing_y, decoder.heights_level);
  info.unit = m.unit.c_str();
  info.vertical_datum = m.vertical_datum.c_str();
  info.crs = m.crs.c_str();
}

}  // namespace

}  // namespace tetrakis::inline api

tks_status tks_get_info(const tks_decoder* decoder, tks_info* info) {
  constexpr size_t kVersions = offsetof(tks_info, header_bytes);
  if (decoder == nullptr || info == nullptr || info->size < kVersions ||
      info->size > tetrakis::kMostStructBytes)
    return TKS_USAGE;
  return tetrakis::answering([&]() -> tetrakis::Status {
    if (decoder->is_lost) return tetrakis::lost();
    tks_info full = {};
    for (const auto fill :
         {tetrakis::fillStream, tetrakis::fillHeights, tetrakis::fillTexture, tetrakis::fillFrames,
          tetrakis::fillMetadata, tetrakis::fillGeoreference, tetrakis::fillGrid,
          tetrakis::fillPositions, tetrakis::fillQuality})
      fill(*decoder, full);
    tetrakis::giveSized(full, *info);
    return {};
  });
}

tks_status tks_verify(tks_decoder* decoder) {
  return tetrakis::keeping(decoder, [&] { return tetrakis::verify(*decoder); });
}
