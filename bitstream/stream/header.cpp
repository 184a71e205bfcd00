// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/header.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

#include "bitstream/stream/checksum.hpp"
#include "bitstream/stream/correction_tracks.hpp"
#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/header_checks.hpp"

namespace tetrakis::inline stream {

namespace {

enum Parts : uint8_t {
  kGeometry = 1,
  kTexture = 2,
  kMetadata = 4,
  kIndex = 8,
  kLayers = 16,
  kRegions = 32,
  kWeights = 64,
  kGeoreference = 128,
  kAllParts = 255
};

constexpr size_t kFixedBytes = kMagic.size() + 3;  // magic, version, profile, level
constexpr size_t kChecksumBytes = 4;
constexpr uint8_t kWithChecksum = 2;  ///< beside whether the stream is lossless

bool hasRegions(const StreamHeader& header) {
  return (header.geometry && !header.geometry->regions.isDefault()) ||
         (header.texture && !header.texture->regions.isDefault());
}

bool namesRegions(const StreamHeader& header, Component component) {
  if (component == Component::kGeometry)
    return header.geometry && header.geometry->regions.side_log2 > 0;
  return header.texture && header.texture->regions.side_log2 > 0;
}

template <class V>
void visitIndex(V& v, StreamHeader& header) {
  uint64_t count = header.index.size();
  v.varint("packets", count, 1, kMaxHeaderBytes / 2);
  for (uint64_t i = 0; v.ok() && i < count; ++i) {
    if (i == header.index.size()) header.index.emplace_back();  // no sooner than its bytes are seen
    auto& [packet, slope] = header.index[i];
    v.varint("index_head", packet.head, 0, UINT64_MAX);
    if (namesRegions(header, packet.component()))
      v.varint("index_region", packet.track, 0, UINT32_MAX);
    v.u8("index_quality", packet.quality, 0, 255);
    v.u8("index_slope", slope, 0, 255);
  }
}

template <class V>
void visitGeoreference(V& v, StreamHeader& header) {
  Georeference& place = header.georeference;
  TransformBasis basis;
  basis.spacing = northUp(header.metadata.spacing_x, header.metadata.spacing_y);
  if (header.geometry) place.visitHeights(v, basis);
  if (!header.texture) return;
  if (header.geometry && place.heights.has_transform) {
    const double columns = header.texture->shown().width, rows = header.texture->shown().height;
    basis.heights = stretched(place.heights.transform, header.geometry->shown().width / columns,
                              header.geometry->shown().height / rows);
    basis.has_heights = true;
  }
  place.visitTexture(v, basis);
}

/// The body: which parts there are, then the parts.
template <class V>
void visitBody(V& v, StreamHeader& header) {
  uint8_t parts = static_cast<uint8_t>(
      (header.geometry ? kGeometry : 0) | (header.texture ? kTexture : 0) |
      (header.metadata.isDefault() ? 0 : kMetadata) | (header.index.empty() ? 0 : kIndex) |
      (header.layers.isDefault() ? 0 : kLayers) | (hasRegions(header) ? kRegions : 0) |
      (header.texture && header.texture->weights.levels > 0 ? kWeights : 0) |
      (header.georeference.isDefault() ? 0 : kGeoreference));
  v.u8("parts", parts, 1, kAllParts);
  v.varint("payload_bytes", header.payload_bytes, 0, UINT64_MAX >> 1);
  auto promises = static_cast<uint8_t>(header.lossless + (header.payload_crc ? kWithChecksum : 0));
  v.u8("lossless", promises, 0, kWithChecksum + 1);
  header.lossless = promises % kWithChecksum;
  if (promises >= kWithChecksum && !header.payload_crc) header.payload_crc = 0;
  if (header.payload_crc) v.u32("payload_crc", *header.payload_crc);
  v.varint("triangles", header.triangles, 0, UINT32_MAX);
  if (!v.ok()) return;
  if (parts & kGeometry) {
    if (!header.geometry) header.geometry.emplace();
    header.geometry->visit(v);
  }
  if (parts & kTexture) {
    if (!header.texture) header.texture.emplace();
    header.texture->visit(v);
  }
  if (parts & kMetadata) header.metadata.visit(v);
  if (parts & kLayers) header.layers.visit(v);
  if (parts & kRegions) {
    if (header.geometry) header.geometry->regions.visit(v);
    if (header.texture) header.texture->regions.visit(v);
  }
  if ((parts & kWeights) && header.texture)
    header.texture->weights.visit(v, header.texture->colourPlanes());
  if (parts & kGeoreference) visitGeoreference(v, header);
  if (parts & kIndex) visitIndex(v, header);
}

Status needMore(size_t bytes) {
  return {TKS_TRUNCATED, "The stream ends inside its header: at least " + std::to_string(bytes) +
                             " bytes are needed."};
}

/// Smallest n such that neither component has more than 4^(n + 8) samples.
uint8_t levelFor(const StreamHeader& header) {
  uint64_t samples = 0;
  if (header.geometry) {
    const Extent shown = header.geometry->shown();
    samples = uint64_t{shown.width} * shown.height;
  }
  if (header.texture) {
    const Extent shown = header.texture->shown();
    samples = std::max(samples, uint64_t{shown.width} * shown.height);
  }
  const int bits = samples <= 1 ? 0 : static_cast<int>(std::bit_width(samples - 1));
  return static_cast<uint8_t>(std::max(0, (bits + 1) / 2 - 8));
}

}  // namespace

bool Metadata::isDefault() const {
  return scale == 1 && offset == 0 && spacing_x == 0 && spacing_y == 0 && unit.empty() &&
         vertical_datum.empty() && crs.empty();
}

TrackCounts trackCounts(const StreamHeader& header) {
  const auto countOf = [](const auto& component) -> TrackCount {
    if (!component) return {};
    const int side_log2 = component->regions.side_log2;
    return {regionCount(component->width, component->height, side_log2), side_log2 > 0};
  };
  TrackCounts counts = {countOf(header.geometry), countOf(header.texture)};
  if (header.geometry) counts[0].tracks += correctionTracks(*header.geometry, header.layers);
  return counts;
}

std::vector<uint8_t> writeHeader(const StreamHeader& header) {
  assert(header.geometry || header.texture);
  StreamHeader copy = header;
  copy.level = levelFor(header);
  FieldWriter body;
  visitBody(body, copy);
  writeOptionalParts(header.optional_parts, body);
  FieldWriter out;
  out.bytes.assign(kMagic.begin(), kMagic.end());
  out.bytes.insert(out.bytes.end(), {copy.version, copy.profile, copy.level});
  out.put(body.bytes.size());
  out.bytes.insert(out.bytes.end(), body.bytes.begin(), body.bytes.end());
  const uint32_t crc = crc32(out.bytes);
  for (int i = 0; i < 4; ++i) out.bytes.push_back(static_cast<uint8_t>(crc >> (8 * i)));
  return std::move(out.bytes);
}

Result<uint64_t> headerBytes(std::span<const uint8_t> bytes) {
  const size_t known = std::min(bytes.size(), kMagic.size());
  if (!std::equal(kMagic.begin(), kMagic.begin() + static_cast<ptrdiff_t>(known), bytes.begin())) {
    return Status(TKS_CORRUPT, "This is not a Tetrakis stream: it does not begin with TKS 1A.");
  }
  if (bytes.size() < kFixedBytes + 1) return kFixedBytes + 1;
  if (bytes[4] != kFormatVersion || bytes[5] != kMainProfile) {
    return Status(TKS_UNSUPPORTED, "The stream has format version " + std::to_string(bytes[4]) +
                                       ", profile " + std::to_string(bytes[5]) +
                                       "; this decoder knows version 1, profile 0.");
  }
  FieldReader size_reader(bytes.subspan(kFixedBytes), kFixedBytes);
  const uint64_t body_bytes = size_reader.take();
  if (size_reader.starved()) return bytes.size() + 1;
  if (!size_reader.ok()) return size_reader.status();
  if (body_bytes > kMaxHeaderBytes) {
    return Status(TKS_CORRUPT,
                  "Corrupt stream: the header claims " + std::to_string(body_bytes) + " bytes.");
  }
  return kFixedBytes + size_reader.position() + body_bytes + kChecksumBytes;
}

Result<ParsedHeader> readHeader(std::span<const uint8_t> bytes) {
  const Result<uint64_t> needed = headerBytes(bytes);
  if (!needed.ok()) return needed.status();
  if (bytes.size() < *needed) return needMore(*needed);
  ParsedHeader parsed;
  parsed.bytes = *needed;
  StreamHeader& header = parsed.header;
  header.version = bytes[4];
  header.profile = bytes[5];
  header.level = bytes[6];
  const size_t crc_start = parsed.bytes - kChecksumBytes;
  uint32_t crc = 0;
  for (size_t i = 0; i < kChecksumBytes; ++i) crc |= uint32_t{bytes[crc_start + i]} << (8 * i);
  if (crc != crc32(bytes.first(crc_start))) {
    return Status(TKS_CORRUPT, "Corrupt stream: the header's checksum does not match.");
  }
  FieldReader size_reader(bytes.subspan(kFixedBytes), kFixedBytes);
  size_reader.take();
  const size_t body_start = kFixedBytes + size_reader.position();
  const std::span<const uint8_t> body_bytes = bytes.subspan(body_start, crc_start - body_start);
  FieldReader body(body_bytes, body_start);
  visitBody(body, header);
  if (!body.ok()) return body.status();
  header.optional_parts = readOptionalParts(body_bytes.subspan(body.position()));
  if (Status meaning = checkMeaning(header); !meaning.ok()) return meaning;
  if (header.level != levelFor(header)) {
    return Status(TKS_CORRUPT, "Corrupt stream: the level does not fit the sizes.");
  }
  return parsed;
}

}  // namespace tetrakis::inline stream
