// SPDX-License-Identifier: Apache-2.0
// checkMeaning() refuses headers whose fields contradict each other, and crc32() computes their
// checksum.
#include "bitstream/stream/header.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tetrakis::inline stream {

namespace {

/// What the eight steps of each byte come to. Made for each call, which takes microseconds: kept it
/// would be a kilobyte of every module that a page loads.
std::array<uint32_t, 256> stepsOfBytes() {
  std::array<uint32_t, 256> steps{};
  for (uint32_t byte = 0; byte < 256; ++byte) {
    uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0);
    steps[byte] = crc;
  }
  return steps;
}

}  // namespace

void Crc32::add(std::span<const uint8_t> bytes) {
  const std::array<uint32_t, 256> steps = stepsOfBytes();
  for (const uint8_t byte : bytes) crc_ = (crc_ >> 8) ^ steps[(crc_ ^ byte) & 0xff];
}

uint32_t crc32(std::span<const uint8_t> bytes) {
  Crc32 crc;
  crc.add(bytes);
  return crc.value();
}

namespace {

/// Whether an integer sample type has that value.
bool holds(uint8_t sample, double value) {
  constexpr double kLeast[] = {0, -128, 0, -32768, 0, -2147483648.0};
  constexpr double kMost[] = {255, 127, 65535, 32767, 4294967295.0, 2147483647};
  return kLeast[sample] <= value && value <= kMost[sample] && value == std::trunc(value);
}

/// Corrections, and the table that they may stand beside. sample: the type of the heights.
Status checkCorrections(const GeometryLayers& layers, uint8_t sample) {
  const CorrectionKind kind = layers.corrections;
  if (layers.table_bytes > 0 && kind != CorrectionKind::kNone && kind != CorrectionKind::kSamples)
    return {TKS_CORRUPT, "Corrupt stream: its heights have a table beside corrections of steps."};
  if (kind == CorrectionKind::kFacets && sample != TKS_F32)
    return {TKS_CORRUPT, "Corrupt stream: its heights have facets but are no floats."};
  return {};
}

Status checkVoids(const GeometryLayers& layers, uint8_t sample) {
  if ((layers.bridge > 0 || layers.late_mask) && layers.validity_bytes == 0)
    return {TKS_CORRUPT, "Corrupt stream: its heights have bridges but no voids."};
  if (layers.bridge > 0 && layers.late_mask)
    return {TKS_CORRUPT, "Corrupt stream: its heights have bridges and a late mask."};
  const bool integer = sample != TKS_F32;
  if (integer && layers.validity_bytes > 0 &&
      !(layers.has_nodata && holds(sample, layers.nodata))) {
    return {TKS_CORRUPT, "Corrupt stream: integer heights have voids but no value for them."};
  }
  if (integer && std::isinf(layers.nodata))
    return {TKS_CORRUPT, "Corrupt stream: the nodata value of its integer heights is infinite."};
  return {};
}

/// Masks of regions are of what lifting leaves: each level shall have halved both sides.
Status checkRegionMasks(const GeometryHeader& heights, const GeometryLayers& layers) {
  if (!layers.region_masks) return {};
  const bool plain = layers.bridge == 0 && !layers.late_mask && layers.flat_bytes == 0 &&
                     heights.frames.none() && !heights.wavelet.ring && !heights.direct();
  if (plain && takesRegionMasks(heights.extent(), heights.regions.side_log2)) return {};
  return {TKS_CORRUPT,
          "Corrupt stream: masks of regions stand on no grid that regions divide, or beside "
          "bridges, a late mask, flat areas or frames."};
}

Status checkLayers(const StreamHeader& header) {
  const GeometryLayers& layers = header.layers;
  if (!header.geometry) return {};
  const GeometryHeader& heights = *header.geometry;
  if (Status status = checkCorrections(layers, heights.sample); !status.ok()) return status;
  if (layers.flat_bytes > 0 && heights.extent().samples() > GeometryLayers::kMostFlatSamples) {
    return {TKS_CORRUPT, "Corrupt stream: so large a height field has no flat areas."};
  }
  if (Status status = checkRegionMasks(heights, layers); !status.ok()) return status;
  return checkVoids(layers, heights.sample);
}

/// Heights that are drawn or stored are one track, whose samples nothing else holds.
Status checkDirect(const StreamHeader& header) {
  if (!header.geometry || !header.geometry->direct()) return {};
  const GeometryLayers& layers = header.layers;
  if (header.geometry->regions.side_log2 > 0 || !header.geometry->priorities.none() ||
      layers.flat_bytes > 0 || layers.bridge > 0 || layers.late_mask ||
      layers.corrections == CorrectionKind::kSteps ||
      layers.corrections == CorrectionKind::kRelative ||
      layers.corrections == CorrectionKind::kFacets) {
    return {TKS_CORRUPT,
            "Corrupt stream: drawn or stored heights have regions, flat areas, bridges or "
            "corrections of steps."};
  }
  const bool plain = layers.corrections == CorrectionKind::kNone && layers.table_bytes == 0;
  if (header.geometry->drawn || plain) return {};
  return {TKS_CORRUPT, "Corrupt stream: stored heights have corrections or a table."};
}

/// A texture that is drawn or stored is one track of all its channels.
Status checkTexture(const StreamHeader& header) {
  if (!header.texture) return {};
  const TextureHeader& t = *header.texture;
  const Extent shown = t.shown();
  const bool large = shown.width > kMaxTextureSide || shown.height > kMaxTextureSide;
  if (large && t.wavelet.forest == nullptr)
    return {TKS_CORRUPT, "Corrupt stream: its texture has more than 32768 columns or rows."};
  if ((t.opaque || t.alpha_bytes > 0) && (t.channels % 2 == 1 || (t.opaque && t.alpha_bytes > 0)))
    return {TKS_CORRUPT,
            "Corrupt stream: the texture has no channel that is what it is said to be."};
  if (t.white_level > 0 && t.sample != TKS_U16)
    return {TKS_CORRUPT, "Corrupt stream: a texture of 8 bits has a white level."};
  if (t.direct() && (t.regions.side_log2 > 0 || t.weights.levels > 0 || !t.priorities.none() ||
                     t.tables.present || t.alpha_bytes > 0 || t.overlay_bytes > 0)) {
    return {TKS_CORRUPT,
            "Corrupt stream: a drawn or stored texture has regions, weights, priorities, tables, "
            "a mask or an overlay."};
  }
  if (t.bridge > 0 && !t.hidden && t.overlay_bytes == 0)
    return {TKS_CORRUPT, "Corrupt stream: its texture has bridges but nothing that they go over."};
  return {};
}

Status checkPriorities(const StreamHeader& header) {
  const auto sound = [](const auto& c) {
    if (!c || c->priorities.none()) return true;
    const int log2 = c->priorities.tile_log2;
    return uint64_t{tilesAlong(c->width, log2)} * tilesAlong(c->height, log2) <=
           PriorityHeader::kMostTiles;
  };
  if (sound(header.geometry) && sound(header.texture)) return {};
  return {TKS_CORRUPT, "Corrupt stream: its map of priorities has more than 65536 tiles."};
}

/// docs/FORMAT.md, section 7, "Filters".
bool hasTwoSteps(uint8_t filter) {
  return filter != 2 && filter != 5;
}

/// The tools that may stand on a forest (docs/FORMAT.md, section 2).
Status checkForests(const StreamHeader& header) {
  const auto sound = [](const auto& c) {
    if (!c || c->wavelet.forest == nullptr) return true;
    return c->repeats.none();
  };
  const GeometryLayers& layers = header.layers;
  bool all = sound(header.geometry) && sound(header.texture);
  if (header.geometry && header.geometry->wavelet.forest != nullptr) {
    const bool lifts_all = layers.late_mask && layers.lifted_bytes == 0;
    const auto& filters = header.geometry->wavelet.filters;
    const bool joint = std::all_of(filters.begin(), filters.end(), hasTwoSteps);
    all &= layers.bridge == 0 && (layers.flat_bytes == 0 || joint) &&
           (layers.validity_bytes == 0 || header.geometry->direct() || lifts_all);
  }
  if (header.texture && header.texture->wavelet.forest != nullptr)
    all &= !header.texture->hidden && header.texture->overlay_bytes == 0 &&
           header.texture->bridge == 0;
  if (all) return {};
  return {TKS_CORRUPT,
          "Corrupt stream: a forest has repeated lines, voids that are not lifted or flat "
          "areas beside a filter of four steps."};
}

/// A base mesh has a quad for each patch of a forest.
Status checkBaseMesh(const StreamHeader& header) {
  if (!header.geometry || header.geometry->base_mesh.none()) return {};
  const SharedForest& forest = header.geometry->wavelet.forest;
  if (forest != nullptr && forest->depth() <= BaseMeshHeader::kMostDepth) return {};
  return {TKS_CORRUPT, "Corrupt stream: a base mesh has no forest of patches up to 257 x 257."};
}

/// Triangles that are coded as they are lie under a plane texture.
Status checkTriangleMesh(const StreamHeader& header) {
  if (header.triangle_mesh.none()) return {};
  if (header.geometry)
    return {TKS_CORRUPT, "Corrupt stream: it has heights beside a mesh of triangles."};
  if (!header.texture) return {};
  const WaveletHeader& wavelet = header.texture->wavelet;
  if (header.triangle_mesh.texcoord_bits > 0 && wavelet.forest == nullptr && !wavelet.ring)
    return {};
  return {TKS_CORRUPT,
          "Corrupt stream: the texture of its triangles has no places on them, or is no plane."};
}

/// Frames are planes of coefficients, with no layer but the masks of heights (docs/FORMAT.md,
/// section 2).
Status checkFrames(const StreamHeader& header) {
  const auto plain = [](const auto& c) {
    return !c.direct() && c.wavelet.forest == nullptr && c.repeats.none() && c.priorities.none();
  };
  bool all = true;
  if (header.geometry && !header.geometry->frames.none()) {
    const GeometryLayers& layers = header.layers;
    all &= plain(*header.geometry) && !layers.late_mask && layers.table_bytes == 0 &&
           layers.flat_bytes == 0 && layers.corrections == CorrectionKind::kNone;
  }
  if (header.texture && !header.texture->frames.none()) {
    const TextureHeader& t = *header.texture;
    all &= plain(t) && t.alpha_bytes == 0 && t.overlay_bytes == 0 && t.bridge == 0 &&
           !t.tables.present && t.weights.levels == 0 && t.colour_shears.size() == 1;
  }
  if (header.geometry && header.texture)
    all &= header.geometry->frames.shown() == header.texture->frames.shown();
  const auto refers_well = [](const auto& c) {
    return !c || c->frames.reference == 0 || (!c->frames.none() && c->frames.scales.empty());
  };
  all &= refers_well(header.geometry) && refers_well(header.texture);
  if (all) return {};
  return {TKS_CORRUPT,
          "Corrupt stream: its frames have tools that frames do not have, or heights and texture "
          "have other numbers of them."};
}

/// A decoder may lack what it takes for the components of a later version.
Status checkComponents(const StreamHeader& header) {
  if (header.geometry || header.texture || !header.triangle_mesh.none()) return {};
  if (header.components.empty())
    return {TKS_CORRUPT,
            "Corrupt stream: its header announces neither heights, nor a texture, nor triangles."};
  return {TKS_UNSUPPORTED,
          "The stream holds nothing that this decoder knows: neither heights nor "
          "a texture on a grid."};
}

}  // namespace

Status checkMeaning(const StreamHeader& header) {
  if (Status components = checkComponents(header); !components.ok()) return components;
  if (Status layers = checkLayers(header); !layers.ok()) return layers;
  if (Status forests = checkForests(header); !forests.ok()) return forests;
  if (Status base = checkBaseMesh(header); !base.ok()) return base;
  if (Status mesh = checkTriangleMesh(header); !mesh.ok()) return mesh;
  if (Status direct = checkDirect(header); !direct.ok()) return direct;
  if (Status priorities = checkPriorities(header); !priorities.ok()) return priorities;
  if (Status frames = checkFrames(header); !frames.ok()) return frames;
  return checkTexture(header);
}

}  // namespace tetrakis::inline stream
