// SPDX-License-Identifier: Apache-2.0
#include "api/memory.hpp"

#include <algorithm>

#include "api/heights_bytes.hpp"
#include "api/mesh_bytes.hpp"
#include "api/plane_bytes.hpp"
#include "api/texture_bytes.hpp"

namespace tetrakis::inline api {

uint64_t payloadBytes(const PayloadCount& count, const TrackCounts& tracks) {
  constexpr uint64_t kNode = 160;  // of a track that is known by a byte
  uint64_t known = 0;
  for (size_t c = 0; c < kComponents; ++c) known += std::min(tracks[c].tracks, count.packets);
  // A vector that grows has up to twice its size beside the one before.
  return count.packets * sizeof(PacketHead) + 3 * count.bytes + known * kNode;
}

uint64_t callBytes(const tks_decoder& decoder, const MemoryRequest& request) {
  if (request.part == TKS_PART_TEXTURE) {
    if (decoder.packets.payload.nothingOf(Component::kTexture)) return kDrawnOnceBytes;
    return textureBytes(decoder, request.view);
  }
  if (request.part == TKS_PART_CODED_MESH || request.part == TKS_PART_BUDGET_MESH)
    return meshBytes(decoder, request);
  if (decoder.packets.payload.nothingOf(Component::kGeometry))
    return decoder.parsed.header.geometry->drawn ? kDrawnOnceBytes : kOnceBytes;
  if (decoder.heights && !request.view.window) return 0;
  const HeightsBytes heights(decoder, request.view);
  return request.part == TKS_PART_VALIDITY ? heights.validity() : heights.decoding();
}

}  // namespace tetrakis::inline api
