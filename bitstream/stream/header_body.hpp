// SPDX-License-Identifier: Apache-2.0
// visitBody() visits the body of a header, field by field: what readHeader() and writeHeader()
// share (docs/FORMAT.md, section 2).
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "bitstream/stream/component_details.hpp"
#include "bitstream/stream/component_list.hpp"
#include "bitstream/stream/geometry_header.hpp"
#include "bitstream/stream/header.hpp"

namespace tetrakis::inline stream {

/// Kinds of the parts of a body, but for components (component_list.hpp). Most inform.
enum BodyPart : uint64_t {
  kTriangleMesh = 1,
  kLossless = 64,
  kPayloadCrc = 65,
  kTriangles = 66,
  kMetadata = 67,
  kPlaceOfHeights = 68,
  kPlaceOfTexture = 69,
  kIndex = 70,
  kHeightPositions = 71,
  kTexturePositions = 72,
  kSourceGrid = 73,
  kDetails = 74,
  kSketch = 75,
  kMaterial = 76,
  kPages = 77
};

inline constexpr size_t kFixedBytes = kMagic.size() + 3;  // magic, version, profile, level

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
  v.part(kPlaceOfHeights, (header.geometry || !header.triangle_mesh.none()) && place.hasHeights(),
         [&](auto& part) { place.visitHeights(part, basis); });
  const std::vector<ListedComponent> list = listOf(header);
  const ListedComponent *heights = firstHeights(list), *texture = firstTexture(list);
  if (heights != nullptr && texture != nullptr && place.heights.has_transform) {
    basis.heights = over(place.heights.transform, heights->domain.grid, texture->domain.grid);
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
  v.leadingPart(kSketch, !header.sketch.empty(), [&](auto& part) { part.rest(header.sketch); });
  visitComponents(v, header);
  v.part(kTriangleMesh, !header.triangle_mesh.none(),
         [&](auto& part) { header.triangle_mesh.visit(part); });
  visitPromises(v, header);
  v.part(kMetadata, !header.metadata.isDefault(), [&](auto& part) { header.metadata.visit(part); });
  visitPlaces(v, header);
  v.part(kIndex, !header.index.empty(), [&](auto& part) { visitIndex(part, header); });
  const auto whole = [&](uint64_t kind, std::string& bytes) {
    v.part(kind, !bytes.empty(), [&](auto& part) { part.rest(bytes); });
  };
  whole(kHeightPositions, header.height_positions);
  whole(kTexturePositions, header.texture_positions);
  v.part(kSourceGrid, header.grid.samples() > 0, [&](auto& part) {
    part.varint("grid_width", header.grid.width, 1, kMaxSide);
    part.varint("grid_height", header.grid.height, 1, kMaxSide);
  });
  v.part(kDetails, hasDetails(header), [&](auto& part) { visitDetails(part, header); });
  whole(kMaterial, header.material);
  whole(kPages, header.pages);
  v.endParts(header.later_parts);
}

/// Smallest n such that no component has more than 4^(n + 8) samples.
inline uint8_t levelFor(const StreamHeader& header) {
  uint64_t samples = 0;
  for (const ListedComponent& one : listOf(header))
    samples = std::max(samples, uint64_t{one.domain.grid.width} * one.domain.grid.height);
  const int bits = samples <= 1 ? 0 : static_cast<int>(std::bit_width(samples - 1));
  return static_cast<uint8_t>(std::max(0, (bits + 1) / 2 - 8));
}

}  // namespace tetrakis::inline stream
