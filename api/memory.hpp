// SPDX-License-Identifier: Apache-2.0
// The functions here bound the bytes that a call of a decoder allocates, from the header and before
// the call allocates anything, and hold them against the limit.
//
// Bounds follow what the rooms below keep at the same time: planes of 32-bit values, masks, the
// state of one track a thread (codec/wavelet/region_decoder.hpp), a window's blocks. What meshes
// take is measured (tests/api/decode_memory_test.cpp).
#pragma once

#include <cstdint>

#include "api/decoder.hpp"
#include "base/describe_bytes.hpp"
#include "codec/mesh/topology/lattice.hpp"

namespace tetrakis::inline api {

/// What a call is asked for.
struct MemoryRequest {
  tks_part part = TKS_PART_HEIGHTS;
  View view;                   ///< of viewOf(); meshes ignore it
  uint32_t max_triangles = 0;  ///< of TKS_PART_BUDGET_MESH
};

/// Bytes that the call allocates at its peak, at most; meshes include what they hand over. The
/// stream holds what is asked for.
uint64_t callBytes(const tks_decoder& decoder, const MemoryRequest& request);

/// What a budget mesh of decoded heights with voids takes. callBytes() knows no more triangles than
/// the budget; those in voids are beside it, and judged when they are known.
uint64_t voidMeshBytes(const Lattice& lattice, uint64_t triangles);

/// What tks_decode_screen_mesh allocates at its peak, at most, for a texture of so many texels.
/// triangles: those in voids included.
uint64_t screenMeshBytes(const tks_decoder& decoder, const Lattice& lattice, uint64_t triangles,
                         uint64_t texels);

/// Bytes that a decoder of a payload allocates for what it keeps of that.
uint64_t payloadBytes(const PayloadCount& count, const TrackCounts& tracks);

/// TKS_LIMIT with a sentence if the decoder and so many bytes for the request take more than the
/// limit.
Status checkBytes(const tks_decoder& decoder, const MemoryRequest& request, uint64_t bytes);

/// TKS_LIMIT with a sentence if the decoder, the call and `beside` bytes of the caller's together
/// take more than the limit. Heights that the decoder keeps and the call does not need give way.
Status checkMemory(tks_decoder& decoder, const MemoryRequest& request, uint64_t beside = 0);

}  // namespace tetrakis::inline api
