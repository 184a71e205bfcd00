// SPDX-License-Identifier: Apache-2.0
#include "api/memory.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "api/needed.hpp"

namespace tetrakis::inline api {

uint64_t payloadBytes(const PayloadCount& count, const TrackCounts& tracks) {
  constexpr uint64_t kNode = 160;  // of a track that is known by a byte
  uint64_t known = 0;
  for (size_t c = 0; c < kComponents; ++c) known += std::min(tracks[c].tracks, count.packets);
  // A vector that grows has up to twice its size beside the one before.
  return count.packets * (sizeof(PacketHead) + BorrowedPackets::kPacketBytes) + 3 * count.bytes +
         known * kNode;
}

namespace {

/// The bytes of a view as the caller gets it: of a texture, or of heights, at least as floats.
uint64_t viewBytes(const StreamHeader& header, const MemoryRequest& request) {
  if (request.part != TKS_PART_TEXTURE)
    return std::max(sizeof(float),
                    tks_sample_bytes(static_cast<tks_sample>(header.geometry->sample))) *
           area(request.view.extentIn(header.geometry->shown()));
  const TextureHeader& texture = *header.texture;
  return tks_sample_bytes(static_cast<tks_sample>(texture.sample)) * texture.channels *
         area(request.view.extentIn(texture.shown()));
}

/// The bytes that a call takes beside the codewords that it joins.
uint64_t decodingBytes(const tks_decoder& decoder, const MemoryRequest& request) {
  if (request.part == TKS_PART_TEXTURE) {
    if (texelsAreUnsent(decoder)) return kDrawnOnceBytes;
    return textureBytes(decoder, request.view);
  }
  if (request.part == TKS_PART_CODED_MESH || request.part == TKS_PART_BUDGET_MESH)
    return meshBytes(decoder, request);
  if (heightsAreUnsent(decoder))
    return decoder.parsed.header.geometry->drawn ? kDrawnOnceBytes : kOnceBytes;
  if (decoder.heights && !request.view.window) return 0;
  const HeightsBytes heights(decoder, request.view);
  return request.part == TKS_PART_VALIDITY ? heights.validity() : heights.decoding();
}

/// Of codewords that no call has needed yet.
uint64_t joinedBytes(const tks_decoder& decoder, const MemoryRequest& request) {
  const BorrowedPackets& borrowed = decoder.packets.borrowed;
  if (borrowed.bytes() == 0) return 0;
  const bool texture = request.part == TKS_PART_TEXTURE;
  const Component component = texture ? Component::kTexture : Component::kGeometry;
  const StreamHeader& header = decoder.parsed.header;
  return borrowed.bytesOf(component, neededTracks(header, component, request.view));
}

}  // namespace

uint64_t callBytes(const tks_decoder& decoder, const MemoryRequest& request) {
  const StreamHeader& header = decoder.parsed.header;
  const bool texture = request.part == TKS_PART_TEXTURE;
  // Where there are bytes the tracks are listed, and there may be more than memory holds.
  const bool unsent = texture ? texelsAreUnsent(decoder) : heightsAreUnsent(decoder);
  const uint64_t tracks = texture ? trackBytes(*header.texture) : trackBytes(*header.geometry);
  if (!unsent && tracks > decoder.max_memory) return tracks;
  MemoryRequest decoded = request;
  decoded.view = decodedFor(header, request.part, request.view);
  const bool cut = decoded.view.window != request.view.window;
  return decodingBytes(decoder, decoded) + joinedBytes(decoder, decoded) +
         (cut ? viewBytes(header, decoded) : 0);
}

// Refuses calls that would take more than limits.max_memory, in a sentence.

namespace {

/// "Decoding 32768 x 32768 texels of 4 channels"
std::string describe(const tks_decoder& decoder, const MemoryRequest& request) {
  const StreamHeader& header = decoder.parsed.header;
  const auto sides = [&](const auto& component) {
    const Extent shown = request.view.extentIn(component.shown());
    return std::to_string(shown.width) + " x " + std::to_string(shown.height);
  };
  if (request.part == TKS_PART_TEXTURE) {
    const uint32_t channels = header.texture->channels;
    return "Decoding " + sides(*header.texture) + " texels of " + std::to_string(channels) +
           (channels == 1 ? " channel" : " channels");
  }
  const bool mesh = request.part == TKS_PART_CODED_MESH || request.part == TKS_PART_BUDGET_MESH;
  return (mesh ? "A mesh of " : "Decoding ") + sides(*header.geometry) + " heights";
}

/// The bytes that the decoder holds already.
uint64_t heldBytes(const tks_decoder& decoder) {
  uint64_t bytes = decoder.packets.bytes - decoder.packets.borrowed.bytes() +
                   decoder.pieces.bytes() + decoder.heights_memory.bytes() +
                   decoder.texture_memory.bytes() + decoder.heights_windows.bytes() +
                   decoder.texture_windows.bytes();
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

/// The views that tks_check_memory is asked about.
Result<std::vector<View>> requestedViews(const tks_decoder& decoder, tks_part part,
                                         const tks_window* window) {
  if (part < TKS_PART_HEIGHTS || part > TKS_PART_BUDGET_MESH)
    return Status(TKS_USAGE, "Unknown part of a stream.");
  const Result<std::vector<View>> whole = askedViews(decoder, part, nullptr);
  if (!whole.ok() || window == nullptr) return whole;
  if (part > TKS_PART_TEXTURE) return Status(TKS_USAGE, "Meshes have no windows.");
  return askedViews(decoder, part, window);
}

/// Views of a call are decoded one after the other; if there are several, each is copied to its
/// place.
Status checkViews(tks_decoder& decoder, MemoryRequest each, std::span<const View> views,
                  uint64_t beside, uint64_t* bytes) {
  if (bytes != nullptr) *bytes = 0;
  for (const View& view : views) {
    each.view = view;
    const uint64_t copied = views.size() > 1 ? viewBytes(decoder.parsed.header, each) : 0;
    if (bytes != nullptr) *bytes = std::max(*bytes, callBytes(decoder, each) + copied);
    const Status status = checkMemory(decoder, each, saturatingSum(beside, copied));
    if (!status.ok()) return status;
  }
  return {};
}

}  // namespace

Status checkWork(const tks_decoder& decoder, const std::string& work, uint64_t bytes) {
  const uint64_t all = saturatingSum(heldBytes(decoder), bytes);
  if (all <= decoder.max_memory) return {};
  return {TKS_LIMIT, work + " takes " + describeBytes(all) +
                         " of memory; the limit (max_memory) is " +
                         describeBytes(decoder.max_memory) + "."};
}

Status checkBytes(const tks_decoder& decoder, const MemoryRequest& request, uint64_t bytes) {
  return checkWork(decoder, describe(decoder, request), bytes);
}

Status checkMemory(tks_decoder& decoder, const MemoryRequest& request, uint64_t beside) {
  const auto check = [&] {
    return checkBytes(decoder, request, saturatingSum(callBytes(decoder, request), beside));
  };
  Status status = check();
  if (!status.ok() && decoder.most_of_windows > 0) {
    forgetWindows(decoder);
    status = check();
  }
  if (!status.ok() && decoder.remembers) {
    forget(decoder);
    status = check();
  }
  const bool gives_way = request.part == TKS_PART_TEXTURE || request.view.window.has_value();
  if (status.ok() || !gives_way || !decoder.heights) return status;
  decoder.heights.reset();
  return check();
}

}  // namespace tetrakis::inline api

tks_status tks_check_memory(tks_decoder* decoder, tks_part part, const tks_window* window,
                            uint32_t max_triangles, uint64_t beside, uint64_t* bytes) {
  return tetrakis::keeping(decoder, [&]() -> tetrakis::Status {
    const auto views = tetrakis::requestedViews(*decoder, part, window);
    if (!views.ok()) return views.status();
    return tetrakis::checkViews(*decoder, {part, {}, max_triangles}, *views, beside, bytes);
  });
}
