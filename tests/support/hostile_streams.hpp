// SPDX-License-Identifier: Apache-2.0
// Streams of a few bytes that declare planes of the largest sizes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bitstream/stream/header.hpp"

namespace tetrakis::test {

struct HostileStream {
  std::string name;
  std::vector<uint8_t> bytes;
  bool sent = false;  ///< there is a byte of the component's only track
};

namespace detail {

inline HostileStream sealed(const std::string& name, StreamHeader header, bool sent = false) {
  std::vector<uint8_t> payload;
  // A packet of three bytes, of an unsplit component.
  if (sent) payload = {uint8_t{3 << 2}, 90, 0xa5, 0x5a, 0x33};
  header.payload_bytes = payload.size();
  HostileStream stream{name, writeHeader(header), sent};
  stream.bytes.insert(stream.bytes.end(), payload.begin(), payload.end());
  return stream;
}

inline StreamHeader heightsHeader(uint32_t width, uint32_t height, uint8_t planes) {
  StreamHeader header;
  header.geometry.emplace();
  header.geometry->width = width;
  header.geometry->height = height;
  header.geometry->sample = TKS_F32;
  header.geometry->planes = planes;
  header.geometry->base = 12.5;
  return header;
}

inline StreamHeader textureHeader(uint32_t side, uint8_t planes) {
  StreamHeader header;
  header.texture.emplace();
  header.texture->width = header.texture->height = side;
  header.texture->channels = 4;
  header.texture->sample = TKS_U8;
  header.texture->planes = planes;
  header.texture->centre = {100, 120, 140, 160};
  return header;
}

}  // namespace detail

/// width: of heights of width * 2^12 samples, side: of textures. One of every kind.
inline std::vector<HostileStream> hostileStreams(uint32_t width = 1 << 20,
                                                 uint32_t side = 1 << 15) {
  using namespace detail;
  const uint32_t height = width > 1 << 12 ? 1 << 12 : width;
  std::vector<HostileStream> streams;
  for (const uint8_t planes : {uint8_t{0}, uint8_t{20}}) {
    const std::string kind = planes == 0 ? " constant" : " unsent";
    StreamHeader heights = heightsHeader(width, height, planes);
    StreamHeader texture = textureHeader(side, planes);
    streams.push_back(sealed("heights," + kind, heights));
    streams.push_back(sealed("texture," + kind, texture));
    heights.geometry->regions.side_log2 = texture.texture->regions.side_log2 = 4;
    streams.push_back(sealed("heights in regions," + kind, heights));
    streams.push_back(sealed("texture in regions," + kind, texture));
    heights.geometry->regions = {};
    heights.layers.validity_bytes = 40;
    heights.layers.corrections = CorrectionKind::kSamples;
    heights.layers.coefficient_bytes = 7;
    streams.push_back(sealed("heights with voids and corrections," + kind, heights));
    heights.layers.bridge = 7;
    streams.push_back(sealed("heights with bridges and corrections," + kind, heights));
    heights.layers.bridge = 0;
    heights.layers.late_mask = true;
    heights.layers.lifted_bytes = 20;
    heights.layers.validity_after = 5;
    streams.push_back(sealed("heights with a late mask and corrections," + kind, heights));
    texture.texture->regions = {};
    texture.texture->alpha_bytes = 9;
    texture.texture->hidden = 1;
    texture.texture->overlay_bytes = 30;
    streams.push_back(sealed("cut-out with an overlay," + kind, texture));
    texture.texture->bridge = 7;
    streams.push_back(sealed("cut-out with a bridged overlay," + kind, texture));
  }
  streams.push_back(sealed("drawn", textureHeader(side, kDrawnPlanes)));
  StreamHeader drawing = heightsHeader(width, height, GeometryHeader::kDirectPlanes);
  drawing.geometry->drawn = true;
  streams.push_back(sealed("heights drawn, sent", drawing, true));
  drawing.layers.validity_bytes = 40;
  drawing.layers.corrections = CorrectionKind::kSamples;
  drawing.layers.coefficient_bytes = 7;
  drawing.layers.table_bytes = 9;
  drawing.layers.table_values = 1 << 20;
  streams.push_back(sealed("heights drawn with all layers, sent", drawing, true));
  streams.push_back(sealed("heights, sent", heightsHeader(width, height, 20), true));
  streams.push_back(sealed("texture, sent", textureHeader(side, 20), true));
  streams.push_back(sealed("drawn, sent", textureHeader(side, kDrawnPlanes), true));
  return streams;
}

}  // namespace tetrakis::test
