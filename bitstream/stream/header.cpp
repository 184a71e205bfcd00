// SPDX-License-Identifier: Apache-2.0
#include "bitstream/stream/header.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <utility>

#include "bitstream/stream/component_list.hpp"
#include "bitstream/stream/fields.hpp"
#include "bitstream/stream/geometry_header.hpp"

namespace tetrakis::inline stream {

namespace {

/// Kinds of the parts of a body that inform; those of the others: component_list.hpp.
enum BodyPart : uint64_t {
  kLossless = 64,
  kPayloadCrc = 65,
  kTriangles = 66,
  kMetadata = 67,
  kPlaceOfHeights = 68,
  kPlaceOfTexture = 69,
  kIndex = 70,
  kHeightPositions = 71,
  kTexturePositions = 72,
  kSourceGrid = 73
};

constexpr size_t kFixedBytes = kMagic.size() + 3;  // magic, version, profile, level
constexpr size_t kChecksumBytes = 4;

template <class V>
void visitIndex(V& v, StreamHeader& header) {
  const TrackCounts counts = trackCounts(header);
  uint64_t count = header.index.size();
  v.varint("packets", count, 1, kMaxHeaderBytes / 2);
  for (uint64_t i = 0; v.ok() && i < count; ++i) {
    if (i == header.index.size()) header.index.emplace_back();  // no sooner than its bytes are seen
    auto& [packet, slope] = header.index[i];
    uint64_t head = fieldOf(packet, counts);
    v.varint("index_head", head, 0, UINT64_MAX);
    if constexpr (V::kReads) packet = headOf(head, counts);
    if (counts.of(packet).named) v.varint("index_region", packet.track, 0, UINT32_MAX);
    v.u8("index_quality", packet.quality, 0, 255);
    v.u8("index_slope", slope, 0, 255);
  }
}

template <class V>
void visitPlaces(V& v, StreamHeader& header) {
  Georeference& place = header.georeference;
  TransformBasis basis;
  basis.spacing = northUp(header.metadata.spacing_x, header.metadata.spacing_y);
  v.part(kPlaceOfHeights, header.geometry && place.hasHeights(),
         [&](auto& part) { place.visitHeights(part, basis); });
  if (header.geometry && header.texture && place.heights.has_transform) {
    const double columns = header.texture->shown().width, rows = header.texture->shown().height;
    basis.heights = stretched(place.heights.transform, header.geometry->shown().width / columns,
                              header.geometry->shown().height / rows);
    basis.has_heights = true;
  }
  v.part(kPlaceOfTexture, header.texture && place.hasTexture(),
         [&](auto& part) { place.visitTexture(part, basis); });
}

template <class V>
void visitPromises(V& v, StreamHeader& header) {
  header.lossless = v.part(kLossless, header.lossless > 0, [](auto&) {});
  uint32_t crc = header.payload_crc.value_or(0);
  if (v.part(kPayloadCrc, header.payload_crc.has_value(),
             [&](auto& part) { part.u32("payload_crc", crc); }))
    header.payload_crc = crc;
  v.part(kTriangles, header.triangles > 0,
         [&](auto& part) { part.varint("triangles", header.triangles, 1, UINT32_MAX); });
}

template <class V>
void visitBody(V& v, StreamHeader& header) {
  v.varint("payload_bytes", header.payload_bytes, 0, UINT64_MAX >> 1);
  visitComponents(v, header);
  visitPromises(v, header);
  v.part(kMetadata, !header.metadata.isDefault(), [&](auto& part) { header.metadata.visit(part); });
  visitPlaces(v, header);
  v.part(kIndex, !header.index.empty(), [&](auto& part) { visitIndex(part, header); });
  const auto positions = [&](uint64_t kind, std::string& bytes) {
    v.part(kind, !bytes.empty(), [&](auto& part) { part.rest(bytes); });
  };
  positions(kHeightPositions, header.height_positions);
  positions(kTexturePositions, header.texture_positions);
  v.part(kSourceGrid, header.grid.samples() > 0, [&](auto& part) {
    part.varint("grid_width", header.grid.width, 1, kMaxSide);
    part.varint("grid_height", header.grid.height, 1, kMaxSide);
  });
  v.endParts(header.later_parts);
}

Status needMore(size_t bytes) {
  return {TKS_TRUNCATED, "The stream ends inside its header: at least " + std::to_string(bytes) +
                             " bytes are needed."};
}

/// Smallest n such that no component has more than 4^(n + 8) samples.
uint8_t levelFor(const StreamHeader& header) {
  uint64_t samples = 0;
  for (const ListedComponent& one : listOf(header))
    samples = std::max(samples, uint64_t{one.domain.grid.width} * one.domain.grid.height);
  const int bits = samples <= 1 ? 0 : static_cast<int>(std::bit_width(samples - 1));
  return static_cast<uint8_t>(std::max(0, (bits + 1) / 2 - 8));
}

}  // namespace

bool Metadata::isDefault() const {
  return scale == 1 && offset == 0 && spacing_x == 0 && spacing_y == 0 && unit.empty() &&
         vertical_datum.empty() && crs.empty();
}

TrackCounts trackCounts(const StreamHeader& header) {
  TrackCounts counts;
  for (const ListedComponent& one : listOf(header)) {
    TrackCount count{0, one.region_log2 > 0};
    if (one.component == Component::kGeometry)
      count.tracks =
          coefficientTracks(*header.geometry) + correctionTracks(*header.geometry, header.layers);
    if (one.component == Component::kTexture)
      count.tracks = regionCount(header.texture->width, header.texture->height, one.region_log2);
    counts.add(one.component, count);
  }
  return counts;
}

std::vector<uint8_t> writeHeader(const StreamHeader& header) {
  assert(header.geometry || header.texture);
  StreamHeader copy = header;
  copy.level = levelFor(header);
  FieldWriter body;
  visitBody(body, copy);
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
  FieldReader body(bytes.subspan(body_start, crc_start - body_start), body_start);
  visitBody(body, header);
  if (!body.ok()) return body.status();
  if (Status meaning = checkMeaning(header); !meaning.ok()) return meaning;
  if (header.level != levelFor(header)) {
    return Status(TKS_CORRUPT, "Corrupt stream: the level does not fit the sizes.");
  }
  return parsed;
}

}  // namespace tetrakis::inline stream
