// SPDX-License-Identifier: Apache-2.0
// Refuses calls that would take more than limits.max_memory, in a sentence.
#include <array>
#include <cstdio>
#include <limits>
#include <string>

#include "api/memory.hpp"
#include "wavelet/mip_level.hpp"

namespace tetrakis {

namespace {

/// "Decoding 32768 x 32768 texels of 4 channels"
std::string describe(const tks_decoder& decoder, const MemoryRequest& request) {
  const StreamHeader& header = decoder.parsed.header;
  const auto sides = [&](const auto& part, int level) {
    const Extent size = MipLevel(part.width, part.height, level).size();
    return std::to_string(request.window ? request.window->width : size.width) + " x " +
           std::to_string(request.window ? request.window->height : size.height);
  };
  if (request.part == TKS_PART_TEXTURE) {
    const uint32_t channels = header.texture->channels;
    return "Decoding " + sides(*header.texture, decoder.texture_level) + " texels of " +
           std::to_string(channels) + (channels == 1 ? " channel" : " channels");
  }
  const bool mesh = request.part == TKS_PART_CODED_MESH || request.part == TKS_PART_BUDGET_MESH;
  return (mesh ? "A mesh of " : "Decoding ") + sides(*header.geometry, decoder.heights_level) +
         " heights";
}

/// What the decoder holds already.
uint64_t heldBytes(const tks_decoder& decoder) {
  uint64_t bytes = decoder.payload_bytes;
  if (!decoder.heights) return bytes;
  const DecodedGeometry& geometry = decoder.heights->geometry;
  bytes +=
      sizeof(int32_t) * (geometry.heights.capacity() + decoder.heights->corrections.capacity());
  return bytes + geometry.significant.capacity() + geometry.valid.capacity();
}

uint64_t saturatingSum(uint64_t a, uint64_t b) {
  return a > std::numeric_limits<uint64_t>::max() - b ? std::numeric_limits<uint64_t>::max()
                                                      : a + b;
}

/// That the stream holds what is asked for.
Status checkRequest(const tks_decoder& decoder, const MemoryRequest& request) {
  const StreamHeader& header = decoder.parsed.header;
  if (request.part < TKS_PART_HEIGHTS || request.part > TKS_PART_BUDGET_MESH)
    return {TKS_USAGE, "Unknown part of a stream."};
  const bool texture = request.part == TKS_PART_TEXTURE;
  if (texture && !header.texture) return noTexture();
  if (!texture && !header.geometry) return noHeights();
  if (request.window == nullptr) return {};
  if (texture)
    return checkWindow(request.window, header.texture->width, header.texture->height,
                       decoder.texture_level);
  if (request.part != TKS_PART_HEIGHTS)
    return {TKS_USAGE, "Only heights and textures have windows."};
  return checkWindow(request.window, header.geometry->width, header.geometry->height,
                     decoder.heights_level);
}

}  // namespace

Status checkBytes(const tks_decoder& decoder, const MemoryRequest& request, uint64_t bytes) {
  const uint64_t all = saturatingSum(heldBytes(decoder), bytes);
  if (all <= decoder.max_memory) return {};
  return {TKS_LIMIT, describe(decoder, request) + " takes " + describeBytes(all) +
                         " of memory; the limit (max_memory) is " +
                         describeBytes(decoder.max_memory) + "."};
}

Status checkMemory(tks_decoder& decoder, const MemoryRequest& request, uint64_t beside) {
  const auto check = [&] {
    return checkBytes(decoder, request, saturatingSum(callBytes(decoder, request), beside));
  };
  Status status = check();
  const bool gives_way = request.part == TKS_PART_TEXTURE || request.window != nullptr;
  if (status.ok() || !gives_way || !decoder.heights) return status;
  decoder.heights.reset();
  return check();
}

}  // namespace tetrakis

tks_status tks_check_memory(tks_decoder* decoder, tks_part part, const tks_window* window,
                            uint32_t max_triangles, uint64_t beside, uint64_t* bytes) {
  return tetrakis::keeping(decoder, [&]() -> tetrakis::Status {
    const tetrakis::MemoryRequest request{part, window, max_triangles};
    if (tetrakis::Status s = tetrakis::checkRequest(*decoder, request); !s.ok()) return s;
    if (bytes != nullptr) *bytes = tetrakis::callBytes(*decoder, request);
    return tetrakis::checkMemory(*decoder, request, beside);
  });
}
