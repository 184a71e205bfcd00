// SPDX-License-Identifier: Apache-2.0
// The packets of a stream in another order: nothing is decoded or encoded but a coarse surface, for
// what is hidden.
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "api/message.hpp"
#include "api/screen_camera.hpp"
#include "api/sighting.hpp"

namespace tetrakis::inline api {
namespace {

Result<std::vector<WeightedSighting>> sightingsOf(tks_decoder& decoder,
                                                  const tks_screen_camera* cameras,
                                                  uint32_t count) {
  if (count == 0 || cameras == nullptr) return Status(TKS_USAGE, "The cameras are missing.");
  const Result<CoarseGround> ground = coarseGround(decoder);
  if (!ground.ok()) return ground.status();
  std::vector<WeightedSighting> sightings;
  const auto* bytes = reinterpret_cast<const std::byte*>(cameras);
  for (uint32_t i = 0; i < count; ++i) {
    const auto& given = *reinterpret_cast<const tks_screen_camera*>(bytes + i * cameras->size);
    const std::string name = "camera " + std::to_string(i + 1) + " of " + std::to_string(count);
    tks_screen_camera camera{};
    Status status = takeCamera(name, given, camera);
    if (status.ok() && given.size != cameras->size)
      status = {TKS_USAGE, "All cameras take structs of one size."};
    if (!status.ok()) return status;
    sightings.push_back({sightingOf(*ground, camera, decoder.parsed.header.triangles),
                         camera.weight > 0 ? camera.weight : 1});
  }
  return sightings;
}

/// The packets of the stream one after the other, heads included; one that is cut is the last.
std::vector<std::span<const uint8_t>> packetsOf(const tks_decoder& decoder) {
  const StreamHeader& header = decoder.parsed.header;
  const TrackCounts counts = trackCounts(header);
  std::span<const uint8_t> left = decoder.data.subspan(decoder.parsed.bytes);
  left = left.first(std::min<uint64_t>(left.size(), header.payload_bytes));
  std::vector<std::span<const uint8_t>> packets;
  for (const auto& [head, slope] : header.index) {
    const bool named = counts[static_cast<size_t>(head.component())].named;
    const uint64_t bytes = headBytes(head, named).size() + (head.head >> 2);
    packets.push_back(left.first(std::min<uint64_t>(left.size(), bytes)));
    left = left.subspan(packets.back().size());
  }
  return packets;
}

/// The packets that are whole come first.
void keepCutLast(const tks_decoder& decoder, const std::vector<std::span<const uint8_t>>& packets,
                 std::vector<size_t>& order) {
  const StreamHeader& header = decoder.parsed.header;
  const TrackCounts counts = trackCounts(header);
  const auto is_whole = [&](size_t i) {
    const PacketHead& head = header.index[i].packet;
    const bool named = counts[static_cast<size_t>(head.component())].named;
    return packets[i].size() == headBytes(head, named).size() + (head.head >> 2);
  };
  const auto cut = std::stable_partition(order.begin(), order.end(), is_whole);
  std::sort(cut, order.end());
}

Status reorder(tks_decoder& decoder, const std::vector<WeightedSighting>& sightings,
               tks_buffer& out) {
  const StreamHeader& header = decoder.parsed.header;
  Result<std::vector<size_t>> order = orderFor(header, sightings);
  if (!order.ok()) return order.status();
  const std::vector<std::span<const uint8_t>> packets = packetsOf(decoder);
  keepCutLast(decoder, packets, *order);
  StreamHeader reordered = header;
  for (size_t i = 0; i < order->size(); ++i) reordered.index[i] = header.index[(*order)[i]];
  std::vector<uint8_t> stream = writeHeader(reordered);
  for (const size_t i : *order) stream.insert(stream.end(), packets[i].begin(), packets[i].end());
  out.data = static_cast<uint8_t*>(std::malloc(stream.size()));
  if (out.data == nullptr) throw std::bad_alloc();
  std::memcpy(out.data, stream.data(), stream.size());
  out.size = stream.size();
  return {};
}

}  // namespace
}  // namespace tetrakis::inline api

tks_status tks_reorder(tks_decoder* decoder, const tks_screen_camera* cameras,
                       uint32_t camera_count, tks_buffer* out) {
  if (out == nullptr) return TKS_USAGE;
  *out = {nullptr, 0};
  return tetrakis::keeping(decoder, [&]() -> tetrakis::Status {
    if (decoder->parsed.header.index.empty())
      return {TKS_USAGE, "The stream has no front index, which says what its packets are worth."};
    if (tetrakis::Status status = tetrakis::checkPlanMemory(*decoder); !status.ok()) return status;
    const auto sightings = tetrakis::sightingsOf(*decoder, cameras, camera_count);
    if (!sightings.ok()) return sightings.status();
    return tetrakis::reorder(*decoder, *sightings, *out);
  });
}
